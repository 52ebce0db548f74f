"""Columns of numbers: read quickly, and when one is wrong, told by its line."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray


def read_samples(
    lines: Sequence[str], place: str, first_line: int, *, columns: int = 1, delimiter: str | None = None
) -> NDArray[np.float64]:
    """Read lines of numbers.

    `numpy.loadtxt` (10 ms for 20,000 × 8) is about as quick as pandas' reader (7 ms) and saves its
    import (0.4 s).

    Parameters
    ----------
    lines : sequence of str
        Without line ends; empty lines at the end are skipped.
    place : str
        File for messages.
    first_line : int
        One-based number of `lines[0]` in the file.
    columns : int
        Numbers a line must have.
    delimiter : str, optional
        Between the numbers; None for white space.

    Returns
    -------
    ndarray, shape (n, columns)

    Raises
    ------
    DataError
        With the line of the first thing that is not a finite number.
    """
    end = len(lines)
    while end and not lines[end - 1].strip():
        end -= 1
    lines = lines[:end]
    if not lines:
        raise DataError(f"{place}:{first_line}: there are no samples")
    try:
        values = np.loadtxt(lines, dtype=np.float64, delimiter=delimiter, comments=None, ndmin=2)
    except ValueError:
        values = np.empty((0, 0))
    if values.shape != (len(lines), columns) or not np.isfinite(values).all():
        raise DataError(_first_fault(lines, place, first_line, columns, delimiter))
    return values


def _first_fault(
    lines: Sequence[str], place: str, first_line: int, columns: int, delimiter: str | None
) -> str:
    """Find out, line by line, what `numpy.loadtxt` could not read."""
    for number, line in enumerate(lines, first_line):
        cells = line.split(delimiter)
        if len(cells) != columns:
            wanted = "one number" if columns == 1 else f"{columns} values"
            return f"{place}:{number}: {len(cells)} values where {wanted} should be"
        for cell in cells:
            fault = _fault(cell.strip())
            if fault:
                return f"{place}:{number}: {fault}"
    return f"{place}:{first_line}: the samples cannot be read"


def _fault(cell: str) -> str:
    """Say what is wrong with one sample; empty when nothing is."""
    if cell in {"", "NOVALUE"}:
        return "a sample is missing (NOVALUE); a channel with gaps cannot be graded"
    try:
        value = float(cell)
    except ValueError:
        if "," in cell and cell.replace(",", ".", 1).replace(".", "", 1).lstrip("+-").isdigit():
            hint = "ISO-MME wants a point; for CSV a mapping file says `decimal: ','`"
            return f"`{cell[:40]}` has a decimal comma; {hint}"
        return f"`{cell[:40]}` is not a number"
    if not np.isfinite(value) or "_" in cell:
        return f"`{cell[:40]}` is not a finite number; a channel with gaps cannot be graded"
    return ""
