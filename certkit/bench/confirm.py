"""`confirm`: hold the numbers of a definition against a text on the desk, one by one, and keep who did it.

The answers go into `confirmations/` of the user's own library. Whoever then names that library sees the text,
the place and the person as the source of each number, and `verified` beside it.
"""

from __future__ import annotations

import hashlib
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, cast

import yaml
from msgspec import Struct, field

from certkit.bench.written_value import with_value
from certkit.definitions.confirmation import (
    Confirmation,
    ConfirmedNumber,
    ReadText,
    Signature,
)
from certkit.definitions.loading.confirmed import confirmation_name
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import Loaded, load, names
from certkit.definitions.loading.lint import kind_in
from certkit.definitions.loading.parameter_list import parameters
from certkit.definitions.loading.search_path import is_path
from certkit.definitions.loading.validation import read_bytes
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.errors import UsageError
from certkit.files import write_whole

if TYPE_CHECKING:
    from collections.abc import Iterable

    from pydantic import BaseModel

    from certkit.definitions.loading.kinds import Kind
    from certkit.definitions.loading.parameter_list import ListedParameter

LARGEST_TEXT = 500_000_000
"""Bytes of a file that is hashed; a regulation as a scan has a few million."""


class ConfirmationSession(Struct):
    """One definition beside the text; every answer is kept at once, so that one can stop and go on.

    Parameters
    ----------
    loaded : Loaded
        The definition as it is now.
    library : Path
        Folder of one's own definitions, in which the confirmation is kept.
    text : ReadText
        What was read.
    by : str
        Who reads.
    day : str
        When.
    """

    loaded: Loaded[BaseModel]
    library: Path
    text: ReadText
    by: str
    day: str
    numbers: dict[str, ConfirmedNumber] = field(default_factory=dict)

    @property
    def path(self) -> Path:
        """The file that holds the answers."""
        folder = KINDS["confirmation"].folder
        return self.library / folder / f"{confirmation_name(self.loaded.kind, self.loaded.name)}.yaml"

    def listed(self) -> list[ListedParameter]:
        """Return every number that decides, in the order of the file."""
        return parameters(self.loaded.document)

    def waiting(self, *, countersigning: bool = False) -> list[ListedParameter]:
        """Return the numbers that wait for an answer, or for a second person."""

        def waits(entry: ListedParameter) -> bool:
            known = self.numbers.get(entry.path)
            current = known is not None and known.value == entry.value
            if not countersigning:
                return not current
            return current and known is not None and known.answer == "yes" and known.countersigned is None

        return [entry for entry in self.listed() if waits(entry)]

    def answer(self, path: str, answer: str, place: str = "") -> None:
        """Keep an answer: `yes`, `no`, or the value that the text gives instead.

        Raises
        ------
        UsageError
            When there is no such number, or the value cannot be put in its place.
        """
        entry = self._entry(path)
        if answer not in {"yes", "no"}:
            entry = self._put(entry, answer)
        word = "no" if answer == "no" else "yes"
        self.numbers[path] = ConfirmedNumber(
            answer=word, value=entry.value, place=place, by=self.by, day=self.day
        )
        self._save()

    def countersign(self, path: str) -> None:
        """Sign a number that another person has read.

        Raises
        ------
        UsageError
            When nobody has confirmed it, or the same person has.
        """
        known = self.numbers.get(path)
        if known is None or known.answer != "yes":
            raise UsageError(
                f"{path}: nobody has confirmed it yet; it cannot be countersigned"
                "; confirm it first, with `certkit confirm`"
            )
        if known.by.strip().casefold() == self.by.strip().casefold():
            raise UsageError(f"{path}: {self.by} read it; another person countersigns")
        signed = Signature(by=self.by, day=self.day)
        self.numbers[path] = known.model_copy(update={"countersigned": signed})
        self._save()

    def _entry(self, path: str) -> ListedParameter:
        for entry in self.listed():
            if entry.path == path:
                return entry
        raise UsageError(f"{path}: {self.loaded.path} has no such number; `certkit show` lists them")

    def _put(self, entry: ListedParameter, value: str) -> ListedParameter:
        """Write one's own copy of the definition with another value, and read it."""
        target = self.library / KINDS[self.loaded.kind].folder / f"{self.loaded.name}.yaml"
        if target.exists() and hashlib.sha256(read_bytes(target)).hexdigest() != self.loaded.sha256:
            raise UsageError(f"{target}: exists, and is another than {self.loaded.path}; name that file")
        text = with_value(self.loaded, entry, value)
        write_whole(target, text)
        self.loaded = load(self.loaded.kind, target)
        return self._entry(entry.path)

    def _save(self) -> None:
        name = confirmation_name(self.loaded.kind, self.loaded.name)
        document = Confirmation(confirmation=name, text=self.text, numbers=self.numbers)
        data = document.model_dump(by_alias=True, exclude_none=True, mode="json")
        write_whole(self.path, yaml.safe_dump(data, allow_unicode=True, sort_keys=False, width=110))


def open_confirmation(
    definition: str | Path,
    *,
    by: str,
    library: str | Path = "library",
    kind: str | None = None,
    title: str | None = None,
    document: str | Path | None = None,
) -> ConfirmationSession:
    """Open the confirmation of a definition, a new one or one that was begun.

    Parameters
    ----------
    definition : str or Path
        Name of a definition, or its file.
    by : str
        Who reads.
    library : str or Path
        Folder of one's own definitions; made when missing.
    kind : str, optional
        Where several kinds have a definition of that name.
    title : str, optional
        Title and edition of the text; needed when the confirmation is begun.
    document : str or Path, optional
        The text's file, whose hash is kept.

    Raises
    ------
    UsageError
        When the definition or the text is not clear, or the confirmation was begun with another text.
    """
    if title is not None and len(title.strip()) < 3:
        raise UsageError(
            f"`{title}` is no title; write title and edition, such as --title 'UN R127, 02 series'"
        )
    folder = Path(library)
    store = (folder,) if folder.is_dir() and any(folder.rglob("*.y*ml")) else ()
    loaded = _load(definition, kind, store)
    session = ConfirmationSession(
        loaded,
        folder,
        ReadText(title=title or "-" * 3),
        by.strip(),
        datetime.now(tz=UTC).astimezone().date().isoformat(),
    )
    if not 2 <= len(session.by) <= 200:
        raise UsageError("who reads? name the person with --by")
    digest = None if document is None else _digest(Path(document))
    if not session.path.is_file():
        if title is None:
            raise UsageError("which text is read? name title and edition with --title 'UN R127, 02 series'")
        file = "" if document is None else Path(document).name
        session.text = ReadText(title=title, file=file, sha256=digest)
        return session
    known = cast("Confirmation", load("confirmation", session.path).document)
    if (title not in {None, known.text.title}) or (digest is not None and digest != known.text.sha256):
        raise UsageError(
            f"{session.path}: was begun with another text ({known.text.title}); finish it with that one, or "
            "put the file away and begin anew"
        )
    session.text, session.numbers = known.text, dict(known.numbers)
    return session


def _load(definition: str | Path, kind: str | None, library: tuple[Path, ...]) -> Loaded[BaseModel]:
    if isinstance(definition, Path) or is_path(definition):
        path = Path(definition)
        found = kind or kind_in(read_tree(read_bytes(path), str(path))).word
        return load(found, path, library=library)
    kinds = [known.word for known in KINDS.values() if definition in _names_of(known, library)]
    if kind is None and len(kinds) > 1:
        raise UsageError(f"`{definition}` is a name of several kinds; say which: --kind {' or '.join(kinds)}")
    return load(kind or (kinds or ["corridors"])[0], definition, library=library)


def _names_of(kind: Kind, library: tuple[Path, ...]) -> list[str]:
    return names(kind.word, library) if kind.folder else []


def _digest(path: Path) -> str:
    """Return the SHA-256 of the text's file."""
    digest = hashlib.sha256()
    try:
        if not path.is_file():
            raise UsageError(f"{path}: is no file; name the text that was read")
        if path.stat().st_size > LARGEST_TEXT:
            raise UsageError(
                f"{path}: is larger than {LARGEST_TEXT // 1_000_000} MB; is it the text?; give the text alone"
            )
        with path.open("rb") as stream:
            for block in iter(lambda: stream.read(1 << 20), b""):
                digest.update(block)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read ({error.strerror})") from error
    return digest.hexdigest()


def answered(session: ConfirmationSession) -> tuple[int, int]:
    """Return how many numbers are confirmed, and how many there are."""
    listed = session.listed()
    yes = sum(_confirmed(session, entry) for entry in listed)
    return yes, len(listed)


def _confirmed(session: ConfirmationSession, entry: ListedParameter) -> bool:
    known = session.numbers.get(entry.path)
    return known is not None and known.answer == "yes" and known.value == entry.value


def take_table(session: ConfirmationSession, rows: Iterable[dict[str, str]], *, countersigning: bool) -> int:
    """Take the answers of a filled-in table; return how many there were.

    Parameters
    ----------
    session : ConfirmationSession
    rows : iterable of dict
        With `path`, `value`, `answer` and `place`; a row without an answer is passed over.
    countersigning : bool
        Whether a `yes` is the second person's.

    Raises
    ------
    UsageError
        When a row's number or value is not that of the definition: names the row.
    """
    taken = 0
    today = {entry.path: entry.value for entry in session.listed()}
    for number, row in enumerate(rows, 2):
        answer = row["answer"].strip()
        if not answer:
            continue
        if today.get(row["path"]) != row["value"]:
            raise UsageError(
                f"row {number}: `{row['path']}` is not `{row['value']}` in {session.loaded.path}; "
                "write a new table"
            )
        if countersigning and answer == "yes":
            session.countersign(row["path"])
        elif not countersigning:
            session.answer(row["path"], answer, row["place"].strip())
        taken += 1
    return taken
