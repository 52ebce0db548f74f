"""Locks between processes that end with their process, however it ends.

`fcntl.flock` where there is one; filelock elsewhere (Windows), whose import takes 0.1 s that a run of 0.1 s
should not pay.
"""

from __future__ import annotations

import errno
import os
import sys
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

try:
    import fcntl

    _fcntl: Any = fcntl
except ImportError:
    _fcntl = None

_WITHOUT_LOCKS = frozenset({errno.ENOLCK, errno.ENOTSUP, errno.ENOSYS})
"""What file systems say that have no locks: then there is none to keep."""


@contextmanager
def locked(path: Path, waiting: Callable[[], None] = lambda: None) -> Iterator[None]:
    """Hold the lock file `path`; wait for another process that does. The file is removed at the end.

    Parameters
    ----------
    path : Path
        In a folder that can be written.
    waiting : callable
        Called once when somebody else holds it.
    """
    if _fcntl is None:
        from filelock import FileLock, Timeout  # noqa: PLC0415  # see above

        lock = FileLock(path)
        try:
            lock.acquire(timeout=0)
        except Timeout:
            waiting()
            lock.acquire()
        try:
            yield
        finally:
            lock.release()
            with suppress(OSError):  # who waits has it open, and keeps it there
                path.unlink(missing_ok=True)
        return
    descriptor = _held(path, waiting)
    try:
        yield
    finally:
        path.unlink(missing_ok=True)
        os.close(descriptor)


def _held(path: Path, waiting: Callable[[], None]) -> int:
    """Open and lock the file that has this name when the lock is there: a holder removes it at the end."""
    told = False
    while True:
        descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC | os.O_NOFOLLOW, 0o666)
        try:
            if not lock_descriptor(descriptor, wait=False):
                if not told:
                    waiting()
                    told = True
                lock_descriptor(descriptor)
            with suppress(FileNotFoundError):
                if os.path.samestat(os.fstat(descriptor), path.stat()):
                    return descriptor
        except BaseException:
            os.close(descriptor)
            raise
        os.close(descriptor)


def lock_descriptor(descriptor: int, *, wait: bool = True) -> bool:
    """Lock an open file until it is closed; tell whether it is ours. Where there are no locks it is.

    Raises
    ------
    OSError
        When the file system fails otherwise.
    """
    if _fcntl is None:
        return True
    try:
        _fcntl.flock(descriptor, _fcntl.LOCK_EX | (0 if wait else _fcntl.LOCK_NB))
    except BlockingIOError:
        return False
    except OSError as error:
        if error.errno not in _WITHOUT_LOCKS:
            raise
    return True


def is_held(path: Path) -> bool:
    """Tell whether a process has locked a file. On Windows it need not: no open file can be removed there.

    Raises
    ------
    OSError
        When it cannot be opened.
    """
    if _fcntl is None or sys.platform == "win32":
        return False
    descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    try:
        return not lock_descriptor(descriptor, wait=False)
    finally:
        os.close(descriptor)
