"""Reading plain files of bounded size: no device, no pipe, nothing endless."""

from __future__ import annotations

import os
import stat
from typing import TYPE_CHECKING

from certkit.errors import DataError
from certkit.files.limits import MAX_FILE_BYTES, MEGABYTE

if TYPE_CHECKING:
    from pathlib import Path


def read_bounded(path: Path, label: str | None = None, *, largest: int = MAX_FILE_BYTES) -> bytes:
    """Read a plain file of at most `largest` bytes.

    Parameters
    ----------
    path : Path
    label : str, optional
        What it is called in messages.
    largest : int
        Bytes.

    Raises
    ------
    DataError
        When it is missing, no plain file (a pipe, a device) or too large.
    """
    label = label or str(path)
    try:
        # Without O_NONBLOCK a pipe that nobody writes into would never be opened.
        flags = sum(getattr(os, name, 0) for name in ("O_NONBLOCK", "O_CLOEXEC", "O_BINARY"))
        with os.fdopen(os.open(path, os.O_RDONLY | flags), "rb") as stream:
            status = os.fstat(stream.fileno())
            if not stat.S_ISREG(status.st_mode):
                raise DataError(f"{label}: not a plain file; copy what it yields into one")
            content = stream.read(largest + 1) if status.st_size <= largest else b""
    except OSError as error:
        raise DataError(f"{label}: cannot be read ({error.strerror})") from error
    if status.st_size > largest or len(content) > largest:
        raise DataError(
            f"{label}: {max(status.st_size, len(content)) / MEGABYTE:.0f} MB; "
            f"files above {largest / MEGABYTE:.0f} MB are refused"
        )
    return content
