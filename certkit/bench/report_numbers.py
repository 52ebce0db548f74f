"""The register of report numbers: which number belongs to which report, none of them twice.

A CSV file beside the laboratory's file: number, revision, day of the test, and the hash of what the report is
of. The same test graded again keeps its number, and so does an amended report. A lock beside it keeps other
processes out.
"""

from __future__ import annotations

import csv
import hashlib
import io
from typing import TYPE_CHECKING

from filelock import FileLock

from certkit.errors import DataError, UsageError
from certkit.files import write_whole
from certkit.files.bounded import read_bounded

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.definitions.laboratory import TestDetails

HEADS = ("number", "revision", "day", "report of")
DIGITS = 16


def report_number(register: Path, pattern: str, report_of: str, test: TestDetails, wanted: str = "") -> str:
    """Return the number of a report, and enter it where it is new.

    Parameters
    ----------
    register : Path
        The file; made when missing.
    pattern : str
        `ECL-{year}-{number:04}`; the year is that of the test, and counts for itself.
    report_of : str
        What makes it this report and no other, such as procedure and hashes of the recording.
    test : TestDetails
        Its day and revision.
    wanted : str
        The number that the test's file names itself; empty to be given the next one.

    Raises
    ------
    UsageError
        When the wanted number belongs to another report.
    DataError
        When the register is damaged.
    """
    key = hashlib.sha256(report_of.encode()).hexdigest()[:DIGITS]
    with FileLock(register.with_name(f".{register.name}.lock")):
        rows = _rows(register)
        own = next((row[0] for row in rows if (row[3], row[1]) == (key, str(test.revision))), "")
        if own and wanted in {"", own}:
            return own
        taken = [row for row in rows if row[0] == wanted and row[3] != key]
        if taken:
            raise UsageError(
                f"the number {wanted} belongs to another report, of the test of {taken[0][2]}, by "
                f"{register}; leave `number` out, and the next free one is taken"
            )
        earlier = next((row[0] for row in rows if row[3] == key), "")
        number = wanted or earlier or _next(pattern, test.performed.year, {row[0] for row in rows})
        rows.append((number, str(test.revision), test.performed.isoformat(), key))
        write_whole(register, _text(rows), durable=True)
    return number


def _next(pattern: str, year: int, used: set[str]) -> str:
    """Return the first number of the year that no report has; entries are never taken out."""
    count = 1
    while pattern.format(year=year, number=count) in used:
        count += 1
    return pattern.format(year=year, number=count)


def _rows(register: Path) -> list[tuple[str, str, str, str]]:
    if not register.exists():
        return []
    try:
        text = read_bounded(register).decode("utf-8")
    except UnicodeDecodeError as error:
        raise DataError(f"{register}: not UTF-8 text; restore the register that certkit wrote") from error
    lines = list(csv.reader(io.StringIO(text)))
    if not lines or tuple(lines[0]) != HEADS or any(len(line) != len(HEADS) for line in lines):
        raise DataError(
            f"{register}: not a register of report numbers; restore it, or name another: its columns are "
            f"{', '.join(HEADS)}"
        )
    return [(number, revision, day, of) for number, revision, day, of in lines[1:]]


def _text(rows: list[tuple[str, str, str, str]]) -> str:
    out = io.StringIO()
    table = csv.writer(out, lineterminator="\n")
    table.writerow(HEADS)
    table.writerows(rows)
    return out.getvalue()
