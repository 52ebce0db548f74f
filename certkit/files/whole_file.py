"""Writing files so that a reader never sees half of one."""

from __future__ import annotations

import os
import tempfile
from contextlib import suppress
from pathlib import Path

from certkit.files.process_lock import is_held, lock_descriptor

ENDING = ".part"
"""Of a temporary file's name."""


def write_whole(path: Path, content: bytes | str, *, durable: bool = False) -> None:
    """Write `content` to `path` under a temporary name and move it there when it is whole.

    What writers of the same file left behind when they were killed is removed.

    Parameters
    ----------
    path : Path
        Target; its folder is made when missing. An existing file is replaced in one step.
    content : bytes or str
        Text is written as UTF-8 with the line ends it has.
    durable : bool
        Return only when the file would outlive a power cut, content and name.

    Raises
    ------
    OSError
        When the folder cannot be written; nothing is left behind then.
    """
    data = content.encode() if isinstance(content, str) else content
    path.parent.mkdir(parents=True, exist_ok=True)
    remove_leftovers(path.parent, f".{path.name[:80]}.")
    handle, temporary = _temporary(path)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
            if durable:
                stream.flush()
                os.fsync(stream.fileno())
            # mkstemp makes files for the owner only; a report is as public as its folder lets it be.
            umask = os.umask(0)
            os.umask(umask)
            temporary.chmod(0o666 & ~umask)
            if os.name != "nt":  # Windows moves no open file
                temporary.replace(path)
        if os.name == "nt":
            temporary.replace(path)
        if durable:
            sync_folder(path.parent)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def sync_folder(folder: Path) -> None:
    """Bring a folder's names to the disk; Windows has no such call, and writes them with the file."""
    if os.name == "nt":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def sync_tree(folder: Path) -> None:
    """Bring a folder to the disk with all that is in it."""
    for parent, _, files in os.walk(folder):
        for name in files:
            # A descriptor that may write: Windows asks for it.
            descriptor = os.open(Path(parent, name), os.O_RDWR | getattr(os, "O_BINARY", 0))
            try:
                os.fsync(descriptor)
            finally:
                os.close(descriptor)
        sync_folder(Path(parent))


def _temporary(path: Path) -> tuple[int, Path]:
    """Make a temporary file beside the target, locked while it is open, so that others leave it alone."""
    while True:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name[:80]}.", suffix=ENDING)
        lock_descriptor(handle)
        # Whoever cleans up may have taken it for a leftover before it was locked.
        if os.fstat(handle).st_nlink:
            return handle, Path(name)
        os.close(handle)


def remove_leftovers(folder: Path, prefix: str = ".") -> None:
    """Remove temporary files in a folder that nobody writes any more.

    Parameters
    ----------
    folder : Path
    prefix : str
        What their names begin with: those of all targets when not given.
    """
    with os.scandir(folder) as entries:
        found = [entry.path for entry in entries if entry.name.startswith(prefix)]
    for each in found:
        if each.endswith(ENDING):
            with suppress(OSError):
                if not is_held(Path(each)):
                    Path(each).unlink()
