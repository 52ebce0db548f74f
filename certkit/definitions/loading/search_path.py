"""Where definitions are looked for: folders on disk, or texts at hand (a certificate embeds its own)."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from certkit.definitions.loading.validation import read_bytes
from certkit.definitions.shipped import shipped_root
from certkit.definitions.words import ENDINGS, is_name
from certkit.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from certkit.definitions.loading.kinds import Kind


@dataclass(frozen=True)
class Found:
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


class Shelf(Protocol):
    """A place that definitions are looked for by kind and name."""

    def find(self, kind: Kind, name: str) -> Found | None:
        """Return the definition, or None."""
        ...

    def names(self, kind: Kind) -> list[str]:
        """Return the names of all definitions of a kind, sorted."""
        ...


@dataclass(frozen=True)
class FolderShelf:
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
        """Return the file NAME.yaml; a name never leads out of the folder."""
        check_name(kind, name)
        for place in self._places(kind):
            for ending in ENDINGS:
                path = place / f"{name}{ending}"
                if path.is_file() and _is_of(kind, path):
                    return Found(self._label(path), read_bytes(path), self._file(path), name)
        return None

    def names(self, kind: Kind) -> list[str]:
        """Return the names of all files of a kind."""
        found = {
            path.stem
            for place in self._places(kind)
            if place.is_dir()
            for path in place.iterdir()
            if path.suffix in ENDINGS and path.is_file() and _is_of(kind, path)
        }
        return sorted(found)

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


@dataclass(frozen=True)
class TextShelf:
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


def shipped_shelf() -> FolderShelf:
    """Return the shelf of what comes with certkit."""
    return FolderShelf(shipped_root(), label="")


def check_name(kind: Kind, name: str) -> None:
    """Refuse a name that could lead anywhere else.

    Raises
    ------
    UsageError
        When it is no plain name.
    """
    if not is_name(name):
        raise UsageError(f"`{name}` is no name of a {kind.noun}; use letters, digits, spaces, `-`, `.`")


def _is_of(kind: Kind, path: Path) -> bool:
    """Tell whether a file starts with its kind's key; files of several kinds may lie in one folder."""
    if kind.lives_in(path.parent):
        return True
    with path.open("rb") as stream:
        head = stream.read(4096)
    return re.search(rb"^%b\s*:" % kind.word.encode(), head, re.MULTILINE) is not None
