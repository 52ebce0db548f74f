"""Cells of a table as spreadsheets write them: quoted, with delimiters at the end of each line."""

from __future__ import annotations

import csv
import re
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import DataError
from certkit.plain_text import without_odd_characters

if TYPE_CHECKING:
    from collections.abc import Sequence


FORMULA = ("=", "+", "-", "@")
"""Signs that a spreadsheet takes for the begin of a formula."""


def harmless(text: str) -> str:
    """Return a cell in one line that no spreadsheet runs: one like a formula gets an apostrophe before it."""
    line = re.sub(r"[\r\n\t]+", " ", without_odd_characters(text))
    return f"'{line}" if line.lstrip().startswith(FORMULA) else line


class Cells(Struct, frozen=True):
    """Lines of cells: file, number of the first line, cells in each, and the delimiter between them."""

    place: str
    first: int
    count: int
    delimiter: str


def cells_of(line: str, delimiter: str) -> list[str]:
    """Cut one line into cells, without their quotes."""
    return next(csv.reader([line], delimiter=delimiter), [])


def without_empty_end(cells: list[str]) -> list[str]:
    """Leave out the empty cells at the end of a line."""
    end = len(cells)
    while end and not cells[end - 1].strip():
        end -= 1
    return cells[:end]


def plain_lines(lines: Sequence[str], cells: Cells) -> list[str]:
    """Return lines of cells without quotes, and without empty cells beyond the last column.

    Raises
    ------
    DataError
        When a quoted cell holds the delimiter.
    """
    sign = cells.delimiter
    if any('"' in line for line in lines):
        lines = [_unquoted(line, number, cells) for number, line in enumerate(lines, cells.first)]
    # A line has `count - 1` delimiters; what spreadsheets add stands at its end.
    return [_cut(line, cells.count, sign) if line.count(sign) >= cells.count else line for line in lines]


def _unquoted(line: str, number: int, cells: Cells) -> str:
    if '"' not in line:
        return line
    found = cells_of(line, cells.delimiter)
    odd = next((cell for cell in found if cells.delimiter in cell), None)
    if odd is not None:
        raise DataError(
            f"{cells.place}:{number}: `{odd[:40]}` holds the delimiter `{cells.delimiter}`; write "
            "numbers without thousands signs, or export with another delimiter"
        )
    return cells.delimiter.join(found)


def _cut(line: str, count: int, sign: str) -> str:
    """Take off delimiters at the end as long as there are too many."""
    short = line.rstrip(" ")
    while short.count(sign) >= count and short.endswith(sign):
        short = short[: -len(sign)].rstrip(" ")
    return short
