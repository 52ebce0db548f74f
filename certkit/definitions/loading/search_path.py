"""Where definitions are looked for: folders on disk, or texts at hand (a certificate embeds its own)."""

from __future__ import annotations

import re
from functools import cached_property, lru_cache
from hashlib import sha256
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Protocol

from msgspec import Struct

from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.validation import read_bytes
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.errors import DefinitionError, Problem, UsageError

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from certkit.definitions.loading.kinds import Kind

ENDINGS = (".yaml", ".yml")

_NAME = re.compile(r"[^\W_][\w.,()+ -]{0,99}")
_DEVICE = re.compile(
    r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE
)  # Windows opens no file of such a name


class Found(Struct, frozen=True, dict=True):
    """A definition as found.

    Parameters
    ----------
    label : str
        What it is called in results; never an absolute path.
    data : bytes
        The file.
    file : str
        What it is called in messages: as the user named it.
    name : str, optional
        The name that it was found by, which it has to have; any name will do where it was found by its path.
    """

    label: str
    data: bytes
    file: str
    name: str | None = None

    @cached_property
    def sha256(self) -> str:
        """Return the hash of the file."""
        return sha256(self.data).hexdigest()

    @cached_property
    def text(self) -> str:
        """Return the file as text."""
        return self.data.decode("utf-8-sig")


class DefinitionStore(Protocol):
    """A place that definitions are looked for by kind and name."""

    def find(self, kind: Kind, name: str) -> Found | None:
        """Return the definition, or None."""
        ...

    def names(self, kind: Kind) -> list[str]:
        """Return the names of all definitions of a kind, sorted."""
        ...


class FolderStore(Struct, frozen=True):
    """A folder laid out like the shipped ones (`procedures/`, `models/legforms/`), or with the files in it.

    The last of such folders will do too: a fit writes its family into `families/` beside its legform.

    Parameters
    ----------
    folder : Path
        The folder.
    label : str, optional
        What stands before a file's name in messages and results; the folder as given when missing.
    """

    folder: Path
    label: str | None = None

    def find(self, kind: Kind, name: str) -> Found | None:
        """Return the file NAME.yaml; a name never leads out of the folder.

        Raises
        ------
        DefinitionError
            When there is a file of that name which says of itself no kind: it cannot be read, or is something
            else. Passing it over would let another definition of that name decide.
        """
        check_name(kind, name)
        for place in self._places(kind):
            for path in _definitions_in(place):
                if path.stem == name and (kind.lives_in(place) or _kind_in(path, self._file(path)) is kind):
                    return Found(self._label(path), read_bytes(path), self._file(path), name)
        return None

    def names(self, kind: Kind) -> list[str]:
        """Return the names of all files of a kind."""
        found = set()
        for place in self._places(kind):
            for path in _definitions_in(place):
                try:
                    if kind.lives_in(place) or _kind_in(path, str(path)) is kind:
                        found.add(path.stem)
                except DefinitionError:
                    continue  # told when it is asked for by its name, and by `certkit validate`
        return sorted(found)

    def holds_something(self) -> bool:
        """Tell whether there is any file here that looks like a definition."""
        places = {place for kind in KINDS.values() for place in self._places(kind)}
        return any(True for place in places for _ in _definitions_in(place))

    def _places(self, kind: Kind) -> list[Path]:
        if not kind.folder:
            return []
        last = kind.folder.rpartition("/")[2]
        return [self.folder / kind.folder, self.folder / last, self.folder]

    def _file(self, path: Path) -> str:
        return self._label(path) if self.label == "" else str(path)

    def _label(self, path: Path) -> str:
        inside = path.relative_to(self.folder).as_posix()
        return inside if self.label == "" else f"{self.label or self.folder}/{inside}"


class TextStore(Struct, frozen=True):
    """Definitions at hand: {(kind's word, name): text}, such as a certificate embeds."""

    texts: Mapping[tuple[str, str], str]

    def find(self, kind: Kind, name: str) -> Found | None:
        """Return the text of that kind and name."""
        text = self.texts.get((kind.word, name))
        label = f"{kind.folder}/{name}.yaml"
        return None if text is None else Found(label, text.encode(), label, name)

    def names(self, kind: Kind) -> list[str]:
        """Return the names of all texts of a kind."""
        return sorted(name for word, name in self.texts if word == kind.word)


class RememberedStore(Struct, frozen=True, dict=True):
    """Another store, each of whose definitions is looked for once: all runs of a study meet the same files.

    Parameters
    ----------
    store : DefinitionStore
    """

    store: DefinitionStore

    @cached_property
    def _found(self) -> dict[tuple[str, str], Found | None]:
        return {}

    @cached_property
    def _names(self) -> dict[str, list[str]]:
        return {}

    def find(self, kind: Kind, name: str) -> Found | None:
        """Return the definition as it was found the first time."""
        key = (kind.word, name)
        if key not in self._found:
            self._found[key] = self.store.find(kind, name)
        return self._found[key]

    def names(self, kind: Kind) -> list[str]:
        """Return the names that there were the first time."""
        if kind.word not in self._names:
            self._names[kind.word] = self.store.names(kind)
        return self._names[kind.word]


def shipped_store() -> FolderStore:
    """Return the store of what comes with certkit."""
    return FolderStore(shipped_root(), label="")


def check_name(kind: Kind, name: str) -> None:
    """Refuse a name that could lead anywhere else.

    Raises
    ------
    UsageError
        When it is no plain name.
    """
    if not is_name(name):
        raise UsageError(f"`{name}` is no name of a {kind.noun}; use letters, digits, spaces, `-`, `.`")


def is_name(text: str) -> bool:
    """Tell whether a text is a plain name, which leads to no other folder and to no particular file."""
    plain = _NAME.fullmatch(text) is not None and _DEVICE.fullmatch(text) is None
    return plain and ".." not in text and not text.endswith((*ENDINGS, ".", " "))


def is_path(text: str, flavour: type[PurePath] = PurePath) -> bool:
    """Tell whether a text names a file by its path: with an ending of ours, a folder or a drive in it."""
    path = flavour(text)
    return path.suffix in ENDINGS or len(path.parts) > 1 or bool(path.drive)


@lru_cache(maxsize=1)
def shipped_root() -> Path:
    """Return the folder that holds `procedures/`, `corridors/`, `models/` and the others.

    It lies inside an installed package, at the top of a checkout otherwise.
    """
    package = Path(__file__).parents[2]
    inside = package / "shipped"
    return inside if inside.is_dir() else package.parent


def _definitions_in(place: Path) -> Iterator[Path]:
    """Yield what looks like a definition by its ending, in whatever case that is written."""
    if place.is_dir():
        yield from sorted(path for path in place.iterdir() if path.suffix.lower() in ENDINGS)


def _kind_in(path: Path, file: str) -> Kind:
    """Return the kind that a file says it is; files of several kinds may lie in one folder.

    Raises
    ------
    DefinitionError
        When it cannot be read, or begins with the key of no kind.
    """
    data = read_bytes(path)
    for kind in KINDS.values():
        if data.startswith(f"{kind.word}:".encode()):  # as nearly all do: no need to read the whole file
            return kind
    keys = read_tree(data, file).data
    for key in keys:
        if key in KINDS:
            return KINDS[key]
    first = next(iter(keys), "")
    words = f"begins with `{first}`, which is no kind of definition; mend it, or give it another name"
    raise DefinitionError([Problem(file, 1, 1, words)])


def shown_path(path: Path) -> str:
    """Return a path as it may stand in a result: relative to where we are, or else only its name."""
    if not path.is_absolute():
        return path.as_posix()
    try:
        return path.relative_to(Path.cwd()).as_posix()
    except ValueError:
        return path.name
