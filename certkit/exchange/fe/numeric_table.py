"""A strict reader for numeric CSV tables: a head, then rows of numbers, nothing else.

Pandas would read these files too, but it turns a damaged cell into NaN or a column of text without saying
where; here every cell is a number or an error with its row and column. Reading 800 × 224 cells takes about
30 ms.
"""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes, require_finite
from certkit.files.limits import MAX_VALUES
from certkit.plain_text import without_odd_characters

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray


class NumericTable(Struct, frozen=True):
    """Columns of numbers by their head, in the order of the file."""

    columns: Mapping[str, NDArray[np.float64]]
    source: str
    digest: str


def read_table(path: Path) -> NumericTable:
    """Read a CSV file (`.csv` or `.csv.gz`) of numbers.

    Blanks around heads are dropped; a comma at the end of every line is allowed. Where the head is parted by
    semicolons or tabs, a comma in a number is its decimal point.

    Raises
    ------
    DataError
        For a missing or damaged file, a repeated head, a short or long row, a cell that is no finite number.
    """
    content, digest = read_bytes(path)
    source = str(path)
    head, rows = _rows(content, source)
    # The converter of OpenRadioss leaves control characters in some heads.
    names = [" ".join(plain(name).split()) for name in head]
    _refuse_repeats(names, source)
    values = _numbers(rows, names, source)
    columns = {name: np.ascontiguousarray(values[:, k]) for k, name in enumerate(names)}
    for name, column in columns.items():
        require_finite(column, name, source)
    return NumericTable(columns, source, digest)


def read_cells(path: Path) -> tuple[list[dict[str, str]], str]:
    """Read a small CSV file as text cells by head, with the file's SHA-256."""
    content, digest = read_bytes(path)
    head, rows = _rows(content, str(path))
    names = [name.strip() for name in head]
    _refuse_repeats(names, str(path))
    return [dict(zip(names, (cell.strip() for cell in row), strict=True)) for row in rows], digest


def plain(name: str) -> str:
    """Return a name without characters that have no place in one."""
    return without_odd_characters(name).replace("\N{REPLACEMENT CHARACTER}", "")


def _rows(content: bytes, source: str) -> tuple[list[str], list[list[str]]]:
    """Split into head and rows of equal length, without the empty cell that a comma at the end leaves."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise DataError(
            f"{source}: not a text file (byte {error.start}); is it the native file? Name its format "
            "in the case"
        ) from None
    if content.count(b",") + content.count(b"\n") > MAX_VALUES:
        raise DataError(f"{source}: more than {MAX_VALUES} cells are refused; write fewer histories or rows")
    first = text.lstrip("\n\r").partition("\n")[0]
    mark = next((mark for mark in ";\t" if mark in first and "," not in first), ",")
    try:
        lines = [
            row for row in csv.reader(io.StringIO(text), delimiter=mark) if any(cell.strip() for cell in row)
        ]
    except csv.Error as error:
        raise DataError(f"{source}: no table of numbers ({error}); write the file again") from None
    if len(lines) < 2:
        raise DataError(f"{source}: no rows of numbers below the head; write the file again")
    head, *rows = lines
    if mark != ",":  # then a comma is a decimal one
        rows = [[cell.replace(",", ".") for cell in row] for row in rows]
    trailing = not head[-1].strip()
    if trailing:
        head = head[:-1]
    for number, row in enumerate(rows, start=2):
        # The converter of OpenRadioss ends rows, but not always the head, with a comma.
        if len(row) == len(head) + 1 and not row[-1].strip():
            row.pop()
        if len(row) != len(head):
            raise DataError(
                f"{source}:{number}: {len(row)} cells, the head has {len(head)}; "
                "the file was cut or edited: write it again"
            )
    return head, rows


def _refuse_repeats(names: list[str], source: str) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise DataError(f"{source}: the column `{name}` stands there twice; give each its own name")
        seen.add(name)


def _numbers(rows: list[list[str]], names: list[str], source: str) -> NDArray[np.float64]:
    try:
        return np.array(rows, dtype=np.float64)
    except ValueError:
        for number, row in enumerate(rows, start=2):
            for name, cell in zip(names, row, strict=True):
                try:
                    float(cell)
                except ValueError:
                    found = f"`{cell.strip()}`" if cell.strip() else "an empty cell"
                    raise DataError(
                        f"{source}:{number}: column `{name}`: {found} is not a number; write the file again"
                    ) from None
        raise
