"""The logbook on disk: result documents, and an SQLite index that can be made again from them."""

from __future__ import annotations

import hashlib
import re
import sqlite3
from contextlib import closing
from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from certkit.documents.result import Result
from certkit.errors import DataError
from certkit.exchange.container import read_bounded
from certkit.files import write_whole
from certkit.logbooks.logbook_entry import LogbookEntry, Reading, entry_of

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

INDEX = "logbook.sqlite"
DOCUMENTS = "results"

_TABLES = """
CREATE TABLE tests (
    id TEXT PRIMARY KEY, serial TEXT NOT NULL, day TEXT NOT NULL, number TEXT NOT NULL,
    procedure TEXT NOT NULL, verdict TEXT NOT NULL, kind TEXT NOT NULL
);
CREATE TABLE readings (
    test TEXT NOT NULL REFERENCES tests (id), place INTEGER NOT NULL,
    criterion TEXT NOT NULL, title TEXT NOT NULL, value REAL, unit TEXT NOT NULL,
    lower REAL, upper REAL, verdict TEXT NOT NULL, PRIMARY KEY (test, place)
);
CREATE INDEX tests_of_a_leg ON tests (serial, day);
PRAGMA user_version = 1;
"""


@dataclass(frozen=True)
class Logbook:
    """A folder with the documents in `results/` and the index `logbook.sqlite`."""

    folder: Path

    @property
    def index(self) -> Path:
        """The index."""
        return self.folder / INDEX

    def serials(self) -> list[str]:
        """Return the legforms it knows, sorted."""
        with closing(self._open()) as database:
            rows = database.execute("SELECT DISTINCT serial FROM tests ORDER BY serial").fetchall()
        return [row[0] for row in rows]

    def entries(self, serial: str) -> list[LogbookEntry]:
        """Return a legform's tests in the order in which they were done."""
        with closing(self._open()) as database:
            tests = database.execute(
                "SELECT id, serial, day, number, procedure, verdict, kind FROM tests WHERE serial = ?",
                (serial,),
            ).fetchall()
            rows = database.execute(
                "SELECT test, criterion, title, value, unit, lower, upper, readings.verdict FROM readings "
                "JOIN tests ON tests.id = readings.test WHERE serial = ? ORDER BY test, place",
                (serial,),
            ).fetchall()
        readings: dict[str, list[Reading]] = {}
        for test, *values in rows:
            readings.setdefault(test, []).append(Reading(*values))
        found = [
            LogbookEntry(
                id_,
                leg,
                date.fromisoformat(day),
                number,
                procedure,
                verdict,
                kind,
                tuple(readings.get(id_, ())),
            )
            for id_, leg, day, number, procedure, verdict, kind in tests
        ]
        return sorted(found, key=lambda entry: entry.order)

    def _open(self) -> sqlite3.Connection:
        """Open the index, making it from the documents when it is missing."""
        if not self.index.is_file():
            if not (self.folder / DOCUMENTS).is_dir():
                raise DataError(
                    f"{self.folder}: no logbook here; begin one with `certkit history add RESULT.json`"
                )
            rebuild(self)
        database = sqlite3.connect(self.index)
        try:
            version = database.execute("PRAGMA user_version").fetchone()[0]
        except sqlite3.DatabaseError as error:
            database.close()
            raise DataError(f"{self.index}: damaged; make it again with `certkit history rebuild`") from error
        if version != 1:
            database.close()
            raise DataError(f"{self.index}: of another version; make it again with `certkit history rebuild`")
        return database


def add(logbook: Logbook, documents: Iterable[Path]) -> tuple[list[LogbookEntry], list[LogbookEntry]]:
    """Put result documents into the logbook; all or none.

    Parameters
    ----------
    logbook : Logbook
        Made when missing.
    documents : iterable of Path
        `result.json` files, or folders of runs with one in.

    Returns
    -------
    (list of Entry, list of Entry)
        Those that are new, and those that the logbook had already.

    Raises
    ------
    DataError
        When a document is damaged, was changed, or names no legform and day.
    """
    read = [_read(path / "result.json" if path.is_dir() else path) for path in documents]
    known = (
        {entry.id for serial in logbook.serials() for entry in logbook.entries(serial)}
        if _exists(logbook)
        else set()
    )
    new = {entry.id: (entry, content) for entry, content in read if entry.id not in known}
    for entry, content in new.values():
        write_whole(logbook.folder / DOCUMENTS / _file_name(entry), content)
    if not logbook.index.is_file():
        rebuild(logbook)
    else:
        with closing(sqlite3.connect(logbook.index)) as database, database:
            _insert(database, [entry for entry, _ in new.values()])
    return [entry for entry, _ in new.values()], [entry for entry, _ in read if entry.id in known]


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
    folder = logbook.folder / DOCUMENTS
    if not folder.is_dir():
        raise DataError(
            f"{logbook.folder}: no logbook here; begin one with `certkit history add RESULT.json`"
        )
    entries = [_read(path)[0] for path in sorted(folder.glob("*.json"))]
    temporary = logbook.index.with_suffix(".new")
    temporary.unlink(missing_ok=True)
    try:
        with closing(sqlite3.connect(temporary)) as database, database:
            database.executescript(_TABLES)
            _insert(database, entries)
        temporary.replace(logbook.index)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    return len(entries)


def _exists(logbook: Logbook) -> bool:
    return logbook.index.is_file() or (logbook.folder / DOCUMENTS).is_dir()


def _read(path: Path) -> tuple[LogbookEntry, bytes]:
    content = read_bounded(path)
    result = Result.from_json(content, str(path))
    if result.content_id() != result.id:
        raise DataError(f"{path}: was changed since it was written; `certkit verify` tells more")
    return entry_of(result, str(path)), content


def _file_name(entry: LogbookEntry) -> str:
    """Return a document's file name: readable, and only of characters that every file system takes.

    Two serials that differ in other characters only are told apart by the id at its end.
    """
    words = re.sub(r"[^A-Za-z0-9.-]+", "-", f"{entry.serial}_{entry.day}_{entry.procedure}").strip("-.")
    digest = hashlib.sha256(entry.id.encode()).hexdigest()[:6]
    return f"{words[:120]}_{re.sub(r'[^A-Za-z0-9-]', '', entry.id)[:40]}{digest}.json"


def _insert(database: sqlite3.Connection, entries: Iterable[LogbookEntry]) -> None:
    for entry in entries:
        database.execute(
            "INSERT OR REPLACE INTO tests VALUES (?, ?, ?, ?, ?, ?, ?)",
            (
                entry.id,
                entry.serial,
                entry.day.isoformat(),
                entry.number,
                entry.procedure,
                entry.verdict,
                entry.kind,
            ),
        )
        database.executemany(
            "INSERT OR REPLACE INTO readings VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
            [
                (entry.id, place, r.criterion, r.title, r.value, r.unit, r.lower, r.upper, r.verdict)
                for place, r in enumerate(entry.readings)
            ],
        )
