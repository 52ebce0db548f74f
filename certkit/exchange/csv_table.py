"""A CSV file cut into remarks, heads and lines of numbers."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.csv_cells import Cells, cells_of, plain_lines, without_empty_end
from certkit.exchange.samples import Lines
from certkit.files.limits import MAX_CHANNELS, MAX_LINE, MAX_SAMPLES, MAX_VALUES

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.channel_mapping import CsvLayout

_NO_NUMBERS = frozenset({"nan", "inf", "-inf", "novalue"})
_SEPARATOR = re.compile(r"\"?sep=.\"?", re.IGNORECASE)  # how spreadsheets name the delimiter to each other
_UNIT = re.compile(r"[\[(]([^\])]*)[\])]\s*$")
_REMARK = re.compile(r"#\s*([A-Za-z][^:]*?)\s*:\s*(.+)")


class CsvTable(Struct, frozen=True):
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
    units : tuple of sequence of (str, int)
        By column, the units that its head and the rows below it name, with their lines.
    """

    place: str
    heads: tuple[str, ...]
    head_line: int
    body: Lines
    remarks: Mapping[str, tuple[str, int]]
    units: tuple[Sequence[tuple[str, int]], ...] = ()

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
                raise DataError(
                    f"{self.head_place}: no column {wanted}; there are {self.body.columns}: correct "
                    "the mapping"
                )
            return wanted - 1
        found = [i for i, head in enumerate(self.heads) if head == wanted]
        if len(found) != 1:
            what = "stands twice" if found else f"is not among them ({', '.join(self.heads[:12])})"
            raise DataError(
                f"{self.head_place}: the column head `{wanted[:60]}` {what}; name the column as it is there, "
                "or by its number"
            )
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
    lines = text.split("\n")
    long = next((number for number, line in enumerate(lines, 1) if len(line) > 20 * MAX_LINE), None)
    if long:
        count = len(lines[long - 1])
        raise DataError(
            f"{place}:{long}: a line of {count} characters; this is no table of channels: name another file"
        )
    if len(lines) > MAX_SAMPLES:
        raise DataError(f"{place}: more than {MAX_SAMPLES} lines are refused; export a shorter record")
    head = _first_plain(lines) if layout is None else layout.head - 1  # -1: no heads, columns go by number
    head += 0 <= head < len(lines) and _SEPARATOR.fullmatch(lines[head]) is not None
    if head >= len(lines):
        raise DataError(f"{place}:{len(lines)}: the file ends before its column heads; export it again")
    delimiter, decimal = _signs(lines, head, layout)
    heads = without_empty_end(cells_of(lines[head], delimiter)) if head >= 0 else []
    first = head + 1 + (layout.skip if layout else 0)
    first += first == head + 1 and _names_units(lines[first : first + 1], delimiter, layout)
    body = lines[first:]
    count = _columns(heads, cells_of(body[0], delimiter) if body else [], layout)
    if count > MAX_CHANNELS:
        raise DataError(
            f"{place}:{head + 1}: {count} columns; more than {MAX_CHANNELS} are "
            "refused: export fewer channels"
        )
    if count * len(body) > MAX_VALUES:
        raise DataError(f"{place}: more than {MAX_VALUES} values are refused; export a shorter record")
    below = [
        (cells_of(line, delimiter), number) for number, line in enumerate(lines[head + 1 : first], head + 2)
    ]
    units = tuple(_units(index, heads, max(head, 0) + 1, below) for index in range(count))
    if layout is None and below and not any(_UNIT.search(word) for word in heads):
        heads = [f"{word} [{told[0][0]}]" if told else word for word, told in zip(heads, units, strict=False)]
    return CsvTable(
        place=place,
        heads=tuple(word.strip() for word in heads),
        head_line=max(head, 0) + 1,
        body=Lines(
            place,
            first + 1,
            plain_lines(body, Cells(place, first + 1, count, delimiter)),
            count,
            delimiter,
            decimal,
        ),
        remarks=_remarks(lines[: max(head, 0)], delimiter, place),
        units=units,
    )


def _columns(heads: list[str], row: list[str], layout: CsvLayout | None) -> int:
    """Return how many columns there are; a mapping may name one by its number that has no head."""
    count = len(heads) or len(without_empty_end(row))
    if layout is None:
        return count
    named = [layout.time.column, *(column.column for column in layout.columns.values())]
    return max(count, *(n for n in named if isinstance(n, int) and n <= len(row)), 0)


def _signs(lines: list[str], head: int, layout: CsvLayout | None) -> tuple[str, str]:
    """Return delimiter and decimal sign: the mapping's, else those that the file shows."""
    if layout is not None:
        return {"tab": "\t"}.get(layout.delimiter, layout.delimiter), layout.decimal
    delimiter = max(",;\t|", key=lambda sign: len(cells_of(lines[head], sign)))
    decimal = "," if delimiter != "," and any("," in line for line in lines[head + 1 :]) else "."
    return delimiter, decimal


def _names_units(rows: list[str], delimiter: str, layout: CsvLayout | None) -> bool:
    """Tell whether the row below the heads has words, as units are, and no number."""
    if not rows or (layout is not None and layout.head == 0):
        return False
    cells = [cell.strip() for cell in cells_of(rows[0], delimiter)]
    numbers = any(re.match(r"[+-]?[.,]?\d", cell) or cell.casefold() in _NO_NUMBERS for cell in cells)
    return any(cells) and not numbers


def _units(
    index: int, heads: list[str], head_line: int, below: list[tuple[list[str], int]]
) -> list[tuple[str, int]]:
    """Return what may be units of a column, from its head's brackets and the rows below, with lines."""
    found = []
    if index < len(heads) and (match := _UNIT.search(heads[index])):
        found.append((match.group(1).strip(), head_line))
    for cells, line in below:
        if index < len(cells) and (text := cells[index].strip().strip("[]()").strip()):
            found.append((text, line))
    return found


def _first_plain(lines: list[str]) -> int:
    """Return the index of the first line that is no remark."""
    return next((index for index, line in enumerate(lines) if not line.startswith(("#", '"#'))), len(lines))


def _remarks(lines: list[str], delimiter: str, place: str) -> dict[str, tuple[str, int]]:
    """Return the `# word: value` lines; a spreadsheet quotes them and fills them up with delimiters.

    Raises
    ------
    DataError
        When a word stands there twice with different values.
    """
    found: dict[str, tuple[str, int]] = {}
    for number, line in enumerate(lines, 1):
        if match := _REMARK.fullmatch(line.rstrip(f" {delimiter}").strip().strip('"')):
            word, text = match.groups()
            before, at = found.setdefault(word, (text, number))
            if before != text:
                raise DataError(
                    f"{place}:{number}: `{word[:40]}` is `{text[:60]}` here and `{before[:60]}` in "
                    f"line {at}; "
                    "keep the right one"
                )
    return found
