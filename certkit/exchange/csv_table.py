"""A CSV file cut into remarks, heads and lines of numbers."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.errors import DataError
from certkit.exchange.container import MAX_CHANNELS, MAX_LINE, MAX_SAMPLES
from certkit.exchange.samples import Lines

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.channel_mapping import CsvLayout

_REMARK = re.compile(r"#\s*([A-Za-z][^:]*?)\s*:\s*(.+)")


@dataclass(frozen=True)
class CsvTable:
    """The file in parts.

    Parameters
    ----------
    place : str
        The file, for messages.
    heads : tuple of str
        Column heads; empty where there are none.
    head_line : int
        Their line, from 1.
    body : Lines
        What stands below.
    remarks : mapping of str to (str, int)
        Value and line of the `# word: value` lines above.
    """

    place: str
    heads: tuple[str, ...]
    head_line: int
    body: Lines
    remarks: Mapping[str, tuple[str, int]]

    @property
    def head_place(self) -> str:
        """`file:line` of the column heads."""
        return f"{self.place}:{self.head_line}"

    def column(self, wanted: str | int) -> int:
        """Return the index of a column by its head or its number from 1.

        Raises
        ------
        DataError
            When there is none, or several.
        """
        if isinstance(wanted, int):
            if not 1 <= wanted <= self.body.columns:
                raise DataError(f"{self.head_place}: no column {wanted}; there are {self.body.columns}")
            return wanted - 1
        found = [i for i, head in enumerate(self.heads) if head == wanted]
        if len(found) != 1:
            what = "stands twice" if found else f"is not among them ({', '.join(self.heads[:12])})"
            raise DataError(f"{self.head_place}: the column head `{wanted[:60]}` {what}")
        return found[0]


def cut(text: str, place: str, layout: CsvLayout | None) -> CsvTable:
    """Cut a file into its parts.

    Parameters
    ----------
    text, place : str
        Content and name.
    layout : CsvLayout, optional
        As a mapping file describes it; certkit's own layout when missing.

    Raises
    ------
    DataError
        When it is longer or wider than any table of channels, or ends before its heads.
    """
    delimiter = "," if layout is None else {"tab": "\t"}.get(layout.delimiter, layout.delimiter)
    lines = text.split("\n")
    long = next((number for number, line in enumerate(lines, 1) if len(line) > 20 * MAX_LINE), None)
    if long:
        count = len(lines[long - 1])
        raise DataError(f"{place}:{long}: a line of {count} characters; this is no table of channels")
    if len(lines) > MAX_SAMPLES:
        raise DataError(f"{place}: more than {MAX_SAMPLES} lines are refused")
    remarks = _remarks(lines) if layout is None else {}
    head = _first_plain(lines) if layout is None else layout.head - 1  # -1: no heads, columns go by number
    if head >= len(lines):
        raise DataError(f"{place}:{len(lines)}: the file ends before its column heads")
    first = head + 1 + (layout.skip if layout else 0)
    heads = next(csv.reader([lines[head]], delimiter=delimiter)) if head >= 0 else []
    body = lines[first:]
    if layout is not None and layout.decimal == ",":
        body = [line.replace(",", ".") for line in body]
    count = len(heads) or (body[0].count(delimiter) + 1 if body else 0)
    if count > MAX_CHANNELS:
        raise DataError(f"{place}:{head + 1}: {count} columns; more than {MAX_CHANNELS} are refused")
    return CsvTable(
        place=place,
        heads=tuple(word.strip() for word in heads),
        head_line=max(head, 0) + 1,
        body=Lines(place, first + 1, body, count, delimiter),
        remarks=remarks,
    )


def _first_plain(lines: list[str]) -> int:
    """Return the index of the first line that is no remark."""
    return next((index for index, line in enumerate(lines) if not line.startswith("#")), len(lines))


def _remarks(lines: list[str]) -> dict[str, tuple[str, int]]:
    found = {}
    for number, line in enumerate(lines[: _first_plain(lines)], 1):
        if match := _REMARK.fullmatch(line.strip()):
            found[match.group(1)] = (match.group(2), number)
    return found
