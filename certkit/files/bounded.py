"""Reading plain files of bounded size: no device, no pipe, nothing endless."""

from __future__ import annotations

import errno
import os
import stat
from typing import TYPE_CHECKING, BinaryIO

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
        with open_plain(path) as stream:
            size = os.fstat(stream.fileno()).st_size
            content = stream.read(largest + 1) if size <= largest else b""
    except OSError as error:
        raise DataError(
            f"{label}: cannot be read ({error.strerror}); check it and its permissions"
        ) from error
    if size > largest or len(content) > largest:
        raise DataError(
            f"{label}: {max(size, len(content)) / MEGABYTE:.0f} MB; "
            f"files above {largest / MEGABYTE:.0f} MB are refused: take a shorter record"
        )
    return content


def open_plain(path: Path) -> BinaryIO:
    """Open a plain file for reading; whoever reads bounds how much.

    Raises
    ------
    OSError
        When it cannot be opened, or is a folder, a pipe or a device.
    """
    # Without O_NONBLOCK a pipe that nobody writes into would never be opened.
    flags = sum(getattr(os, name, 0) for name in ("O_NONBLOCK", "O_CLOEXEC", "O_BINARY"))
    descriptor = os.open(path, os.O_RDONLY | flags)
    mode = os.fstat(descriptor).st_mode
    if not stat.S_ISREG(mode):
        os.close(descriptor)
        code = errno.EISDIR if stat.S_ISDIR(mode) else errno.EINVAL
        why = os.strerror(code) if stat.S_ISDIR(mode) else "not a plain file; copy what it yields into one"
        raise OSError(code, why, str(path))
    return os.fdopen(descriptor, "rb")
