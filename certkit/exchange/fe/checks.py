"""Checks that every finite-element reader makes before it hands numbers on."""

from __future__ import annotations

import gzip
import hashlib
from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.files.bounded import read_bounded
from certkit.files.limits import MAX_HISTORY_BYTES, MEGABYTE

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

FEWEST_ROWS = 10


def read_bytes(path: Path) -> tuple[bytes, str]:
    """Read a file, unpacking `.gz`.

    Returns
    -------
    content : bytes
        The unpacked content.
    digest : str
        SHA-256 of the file as it stands on disk.

    Raises
    ------
    DataError
        When it is missing, unreadable, empty, a damaged archive, or larger than `MAX_HISTORY_BYTES`.
    """
    if not path.exists():
        raise DataError(f"{path}: there is no such file; check the case's `files`")
    raw = read_bounded(path, largest=MAX_HISTORY_BYTES)
    digest = hashlib.sha256(raw).hexdigest()
    content = _unpacked(raw, path) if path.suffix == ".gz" else raw
    if not content:
        raise DataError(f"{path}: the file is empty; write it again from the solver")
    return content, digest


def _unpacked(raw: bytes, path: Path) -> bytes:
    import io  # noqa: PLC0415  # only here

    try:
        with gzip.GzipFile(fileobj=io.BytesIO(raw)) as stream:
            content = stream.read(MAX_HISTORY_BYTES + 1)
    except (OSError, EOFError) as error:
        raise DataError(f"{path}: damaged gzip archive ({error}); copy it again") from None
    if len(content) > MAX_HISTORY_BYTES:
        most = MAX_HISTORY_BYTES // MEGABYTE
        raise DataError(f"{path}: unpacks to more than {most} MB; write fewer histories or fewer rows")
    return content


def require_time_axis(time: NDArray[np.float64], source: str) -> None:
    """Refuse a time axis, shape (n,), of any unit: too short, not finite or not strictly increasing."""
    if time.size < FEWEST_ROWS:
        raise DataError(
            f"{source}: only {time.size} rows; an impact needs at least {FEWEST_ROWS}: write "
            "histories more often"
        )
    if not np.all(np.isfinite(time)):
        row = int(np.flatnonzero(~np.isfinite(time))[0]) + 1
        raise DataError(f"{source}: the time of row {row} is not a finite number; write the file again")
    steps = np.diff(time)
    if np.any(steps <= 0):
        row = int(np.flatnonzero(steps <= 0)[0]) + 2
        raise DataError(
            f"{source}: time does not increase at row {row} ({time[row - 1]:g} after {time[row - 2]:g}); "
            "a restart may have been appended: cut the repeated rows"
        )


def require_finite(values: NDArray[np.float64], name: str, source: str) -> None:
    """Refuse values, shape (n,), that are not finite: a missing number never passes."""
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        raise DataError(
            f"{source}: `{name}` is not a finite number in row {int(bad[0]) + 1}; write the file "
            "again, or leave it out"
        )
