"""Files that only this user can have written: for what is kept and run later, as machine code is.

A folder counts as the user's own when it and its files belong to the user and nobody else may write them, and
when nobody else could have put another in its place. On top of that every file carries a keyed digest
(HMAC-SHA-256) whose key lies beside it and can be read by nobody else. On Windows a profile's folders are the
user's own by themselves; there the key alone is asked for.
"""

from __future__ import annotations

import hashlib
import hmac
import os
import secrets
import stat
from contextlib import suppress
from typing import TYPE_CHECKING

from certkit.files.whole_file import write_whole

if TYPE_CHECKING:
    from pathlib import Path

KEY = "key"
KEY_LENGTH = 32
_DIGEST = hashlib.sha256().digest_size
_OTHERS = stat.S_IWGRP | stat.S_IWOTH


class OwnFolder:
    """A folder of files that only this user can have written.

    Parameters
    ----------
    path : Path
        Absolute; made when missing, for the user alone.

    Raises
    ------
    OSError
        When it cannot be made, or others could write there: says why.
    """

    def __init__(self, path: Path) -> None:
        """Make the folder, look at it and at all above it, and read or make its key."""
        if not path.is_absolute():
            raise PermissionError(f"{path} is no whole path; name it from the root on")
        for folder in (*reversed(path.parents), path):
            if not folder.exists():
                folder.mkdir(mode=0o700, exist_ok=True)
        self.path = path.resolve()
        _check_owner(self.path)
        self._key = self._read_key() or self._made_key()

    def read(self, name: str) -> bytes | None:
        """Return what `write` wrote; None where there is nothing, or what `write` has not written."""
        data = _own_bytes(self.path / name)
        if data is None or not hmac.compare_digest(self._digest(name, data[_DIGEST:]), data[:_DIGEST]):
            return None
        return data[_DIGEST:]

    def write(self, name: str, content: bytes) -> None:
        """Write a file.

        Raises
        ------
        OSError
            When that is impossible.
        """
        write_whole(self.path / name, self._digest(name, content) + content)
        with suppress(OSError):
            (self.path / name).chmod(0o600)

    def _digest(self, name: str, content: bytes) -> bytes:
        return hmac.digest(self._key, name.encode() + b"\0" + content, "sha256")

    def _read_key(self) -> bytes | None:
        key = _own_bytes(self.path / KEY, secret=True)
        return key if key is not None and len(key) == KEY_LENGTH else None

    def _made_key(self) -> bytes:
        """Make a key; where two processes do, that of the first counts."""
        mine = self.path / f".{KEY}.{os.getpid()}"
        mine.unlink(missing_ok=True)
        descriptor = os.open(mine, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o600)
        try:
            with os.fdopen(descriptor, "wb") as stream:
                stream.write(secrets.token_bytes(KEY_LENGTH))
            with suppress(OSError):  # there is one already, or no links in this file system
                os.link(mine, self.path / KEY)
            if self._read_key() is None:
                mine.replace(self.path / KEY)
        finally:
            mine.unlink(missing_ok=True)
        key = self._read_key()
        if key is None:
            raise PermissionError(f"files in {self.path} do not stay the user's own; name another folder")
        return key


def _check_owner(path: Path) -> None:
    """Refuse a folder in which, or in whose place, another user could write."""
    if not hasattr(os, "geteuid"):
        return
    for folder in (path, *path.parents):
        status = folder.stat()
        mine = status.st_uid in ({os.geteuid()} if folder == path else {os.geteuid(), 0})
        # In a sticky folder such as /tmp nobody moves what belongs to others.
        kept = folder != path and status.st_mode & stat.S_ISVTX
        if not mine or (status.st_mode & _OTHERS and not kept):
            raise PermissionError(
                f"others could write in {folder}; take their right to write away, or name another folder"
            )


def _own_bytes(path: Path, *, secret: bool = False) -> bytes | None:
    """Read a plain file of the user's own; None for any other.

    Parameters
    ----------
    path : Path
    secret : bool
        Nobody else may read it either.
    """
    flags = sum(getattr(os, name, 0) for name in ("O_NOFOLLOW", "O_NONBLOCK", "O_CLOEXEC", "O_BINARY"))
    try:
        descriptor = os.open(path, os.O_RDONLY | flags)
    except OSError:
        return None
    with os.fdopen(descriptor, "rb") as stream:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            return None
        if hasattr(os, "geteuid"):
            others = stat.S_IRWXG | stat.S_IRWXO if secret else _OTHERS
            if status.st_uid != os.geteuid() or status.st_mode & others:
                return None
        try:
            return stream.read()
        except OSError:
            return None
