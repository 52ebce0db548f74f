"""Processes that write into one logbook at the same time."""

from __future__ import annotations

import subprocess
import sys
from datetime import timedelta
from pathlib import Path
from typing import NamedTuple

from certkit.logbooks import Logbook
from support.forty_tests import BEGIN, document

WRITE = (
    "import sys; from pathlib import Path; from certkit.logbooks import Logbook, add\n"
    "for path in sys.argv[2:]: add(Logbook(Path(sys.argv[1])), [Path(path)])"
)
LEGS = 3


class Booked(NamedTuple):
    """What a logbook holds afterwards: tests that it shows, of different ids, files, lines of the index."""

    shown: int
    ids: int
    documents: int
    indexed: int


def booked_by(writers: int, tests: int, folder: Path) -> Booked:
    """Let some processes put some tests each into one new logbook, all at once."""
    count = writers * tests
    for n in range(count):
        day = BEGIN + timedelta(days=n)
        document(f"W-{n % LEGS}", day, n, "pendulum", 250.0).write(folder / "in" / f"{n}.json")
    book = Logbook(folder / "book")
    begun = [
        subprocess.Popen(
            [sys.executable, "-c", WRITE, str(book.folder)]
            + [str(folder / "in" / f"{n}.json") for n in range(first, count, writers)]
        )
        for first in range(writers)
    ]
    codes = [writer.wait(timeout=600) for writer in begun]
    assert codes == [0] * writers, codes
    entries = [entry for serial in book.serials() for entry in book.entries(serial)]
    indexed = book.index.read_text("utf-8").count('.json":[[')
    return Booked(
        len(entries), len({entry.id for entry in entries}), len(list(book.documents.iterdir())), indexed
    )
