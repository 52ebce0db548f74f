"""The logbook on disk: result documents, which are the logbook, and an index made from them.

To read many result documents is slow, for they carry their curves. The index keeps what the logbook needs of
each, with the size and time of the file that it was taken from, and a checksum of itself. Whatever does not
agree with the documents is read from them again: an index that is missing, stale, damaged or edited mends
itself.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import re
import warnings
from datetime import date
from typing import TYPE_CHECKING, Any

from filelock import FileLock
from msgspec import Struct, to_builtins

from certkit.documents.result import Result
from certkit.errors import DataError, TakenAsSaidWarning
from certkit.files import write_whole
from certkit.files.bounded import read_bounded
from certkit.files.whole_file import remove_leftovers
from certkit.logbooks.logbook_entry import LogbookEntry, Reading, entry_of, replacements, serial_key
from certkit.logbooks.same_blow import shared_channels

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path

INDEX = "index.json"
DOCUMENTS = "results"
SCHEMA = "certkit-logbook-index/2"


class Logbook(Struct, frozen=True):
    """A folder with the documents in `results/` and the index beside them."""

    folder: Path

    @property
    def index(self) -> Path:
        """The index."""
        return self.folder / INDEX

    @property
    def documents(self) -> Path:
        """The folder of the documents."""
        return self.folder / DOCUMENTS

    def serials(self, *, exact: bool = False) -> list[str]:
        """Return the legforms it knows, sorted, each as it was written first."""
        names: dict[str, str] = {}
        for entry in sorted(self._entries(), key=lambda entry: entry.order):
            names.setdefault(serial_key(entry.serial, exact=exact), entry.serial)
        return sorted(names.values())

    def entries(self, serial: str, *, exact: bool = False) -> list[LogbookEntry]:
        """Return a legform's tests in the order in which they were done.

        Parameters
        ----------
        serial : str
            Its serial number.
        exact : bool
            Whether serial numbers that differ in case and blanks only are two legforms.
        """
        wanted = serial_key(serial, exact=exact)
        found = [entry for entry in self._entries() if serial_key(entry.serial, exact=exact) == wanted]
        return sorted(found, key=lambda entry: entry.order)

    def replaced(self) -> dict[str, str]:
        """Return the id of the report that took the place of each replaced one, in the whole logbook."""
        return replacements(self._entries())

    def results(self, ids: Iterable[str]) -> list[Result]:
        """Return the documents of tests, in the order of their ids.

        Raises
        ------
        DataError
            When the logbook has none of an id.
        """
        with _locked(self):
            names = {entry.id: name for name, entry in _agreed(self).items()}
        wanted = list(ids)
        missing = [each for each in wanted if each not in names]
        if missing:
            raise DataError(f"{self.folder}: has no test {missing[0]}; `certkit history` lists them")
        return [Result.read(self.documents / names[each]) for each in wanted]

    def _entries(self) -> list[LogbookEntry]:
        if not self.documents.is_dir():
            raise DataError(
                f"{self.folder}: no logbook here; begin one with `certkit history add RESULT.json`"
            )
        with _locked(self):
            return list(_agreed(self).values())


def add(
    logbook: Logbook,
    documents: Iterable[Path],
    wrong: Callable[[str, Result], list[str]] = lambda *_: [],
) -> tuple[list[LogbookEntry], list[LogbookEntry]]:
    """Put result documents into the logbook; all or none.

    Parameters
    ----------
    logbook : Logbook
        Made when missing.
    documents : iterable of Path
        `result.json` files, or folders of runs with one in.
    wrong : callable
        Says what is wrong with a result beside that, by its place; it is not booked then.

    Returns
    -------
    (list of LogbookEntry, list of LogbookEntry)
        Those that are new, and those that the logbook had already.

    Raises
    ------
    DataError
        When a document is damaged, was changed, was not measured, names no legform and day, is wrong, or
        grades a recording that the logbook has already under another id.
    """
    read, faults = [], []
    for path in documents:
        file = Result.file_at(path)
        result, content = _read(file)
        read.append((entry_of(result, str(file)), content, file))
        faults += wrong(str(path), result)
    if faults:
        raise DataError("\n".join(faults))
    logbook.documents.mkdir(parents=True, exist_ok=True)
    with _locked(logbook):
        remove_leftovers(logbook.documents)
        kept = _agreed(logbook)
        ids = {entry.id for entry in kept.values()}
        _refuse_second_gradings(read, kept.values())
        new = {entry.id: (entry, content) for entry, content, _ in read if entry.id not in ids}
        for entry, content in new.values():
            write_whole(logbook.documents / _file_name(entry), content, durable=True)
        _agreed(logbook)
    return [entry for entry, _ in new.values()], [entry for entry, _, _ in read if entry.id in ids]


def rebuild(logbook: Logbook) -> int:
    """Make the index again from the documents in the logbook's folder.

    Returns
    -------
    int
        How many tests it holds.

    Raises
    ------
    DataError
        When there is no logbook, or a document in it is damaged.
    """
    with contextlib.suppress(FileNotFoundError):
        logbook.index.unlink()
    return len(logbook._entries())  # noqa: SLF001  # the same module


@contextlib.contextmanager
def _locked(logbook: Logbook) -> Iterator[None]:
    """Keep other processes out, where the folder can be written; who cannot write it only reads."""
    lock = FileLock(logbook.folder / ".lock")
    try:
        lock.acquire()
    except PermissionError:
        yield
        return
    try:
        yield
    finally:
        lock.release()


def _agreed(logbook: Logbook) -> dict[str, LogbookEntry]:
    """Return the entry of each document by its file's name, and bring the index up to them."""
    known = _index(logbook)
    found: dict[str, tuple[list[int], LogbookEntry]] = {}
    for path in sorted(logbook.documents.glob("*.json")):
        state = path.stat()
        stamp = [state.st_size, state.st_mtime_ns]
        before = known.get(path.name)
        found[path.name] = (
            before if before and before[0] == stamp else (stamp, entry_of(_read(path)[0], str(path)))
        )
    if found != known:
        # Whoever may only read the folder does without an index.
        with contextlib.suppress(PermissionError):
            write_whole(logbook.index, _index_text(found), durable=True)
    return {name: entry for name, (_, entry) in found.items()}


def _index(logbook: Logbook) -> dict[str, tuple[list[int], LogbookEntry]]:
    """Return what the index holds, stamp and entry by file name; nothing where it is not as written."""
    try:
        content = read_bounded(logbook.index)
        data = json.loads(content)
        found = {name: (stamp, _entry(fields)) for name, (stamp, fields) in data["files"].items()}
    except (DataError, OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}
    return found if _index_text(found).encode() == content else {}


def _index_text(found: dict[str, tuple[list[int], LogbookEntry]]) -> str:
    """Return the index as text, with the checksum of what it holds."""
    files = {name: [stamp, to_builtins(entry)] for name, (stamp, entry) in found.items()}
    text = json.dumps(files, ensure_ascii=False, sort_keys=True, separators=(",", ":"))
    checksum = hashlib.sha256(text.encode()).hexdigest()
    return f'{{"schema":"{SCHEMA}","sum":"{checksum}",\n"files":{text}}}\n'


def _entry(fields: dict[str, Any]) -> LogbookEntry:
    return LogbookEntry(
        **{
            **fields,
            "day": date.fromisoformat(fields["day"]),
            "readings": tuple(Reading(**reading) for reading in fields["readings"]),
            "recordings": tuple(fields["recordings"]),
            "channels": tuple(fields["channels"]),
        }
    )


def _read(path: Path) -> tuple[Result, bytes]:
    content = read_bounded(path)
    result = Result.from_json(content, str(path))
    if result.content_id() != result.id:
        raise DataError(f"{path}: was changed since it was written; `certkit verify` tells more")
    return result, content


def _refuse_second_gradings(
    read: Sequence[tuple[LogbookEntry, bytes, Path]], kept: Iterable[LogbookEntry]
) -> None:
    """One test counts once, however often it was graded: which grading stands is for people to say."""
    kept = list(kept)
    replaced = replacements((*kept, *(entry for entry, _, _ in read)))
    held = {entry.test_key: entry for entry in kept if entry.recordings and entry.id not in replaced}
    before: list[LogbookEntry] = []
    for entry, _, path in read:
        if entry.id in replaced:
            continue
        _tell_second_use(entry, path, [each for each in (*kept, *before) if each.id not in replaced])
        before.append(entry)
        if not entry.recordings:
            continue
        other = held.setdefault(entry.test_key, entry)
        if other.id != entry.id:
            raise DataError(
                f"{path}: this recording is in the logbook already, as {other.id} ({other.procedure}, "
                f"{other.day}, {other.verdict}); to book another grading, amend that one (`replaces` in "
                f"the laboratory's file), or take it out of `{DOCUMENTS}/`"
            )


def _tell_second_use(entry: LogbookEntry, path: Path, others: Iterable[LogbookEntry]) -> None:
    """Tell of the samples of a test that is there under another number, day or legform: it may be a slip."""
    for other in others:
        if other.id == entry.id or (other.recordings and other.test_key == entry.test_key):
            continue
        same = shared_channels(entry.channels, other.channels)
        if same:
            warnings.warn(
                f"{path}: {same} are sample by sample those of {other.id} ({other.serial}, "
                f"{other.procedure}, {other.day}, number {other.number or 'none'}); one blow is one test: "
                f"grade the right recording, or amend that report (`replaces` in the laboratory's file)",
                TakenAsSaidWarning,
                stacklevel=2,
            )
            return


def _file_name(entry: LogbookEntry) -> str:
    """Return a document's file name: readable, and only of characters that every file system takes.

    Two serials that differ in other characters only are told apart by the id at its end.
    """
    words = re.sub(r"[^A-Za-z0-9.-]+", "-", f"{entry.serial}_{entry.day}_{entry.procedure}").strip("-.")
    digest = hashlib.sha256(entry.id.encode()).hexdigest()[:6]
    return f"{words[:120]}_{re.sub(r'[^A-Za-z0-9-]', '', entry.id)[:40]}{digest}.json"
