"""The journal of finished runs, one whole JSON line each: an interrupted study goes on where it was."""

from __future__ import annotations

import hashlib
import json
import os
from typing import TYPE_CHECKING, Any, Self

from filelock import FileLock, Timeout

from certkit.errors import UsageError
from certkit.files import write_whole
from certkit.studies.points import Outcome

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from certkit.studies.points import Point

JOURNAL = "runs.jsonl"
"""The file, in the folder of a study or fit."""

SUM = "sum"
"""The key of a line's checksum, its last entry."""


class Journal:
    """A file of outcomes by key, which grows by one line a run.

    Each line ends with a checksum of what stands before it. A line that is torn, joined with another or
    edited does not have it: it is dropped when the journal is opened, and its run is done again. A lock
    beside the file keeps a second process out.

    Parameters
    ----------
    path : Path
        The file; made with its folder when missing.
    fresh : bool
        Forget what it holds.

    Raises
    ------
    UsageError
        When another process holds the journal.
    """

    def __init__(self, path: Path, *, fresh: bool = False) -> None:
        """Lock, read and open the journal."""
        path.parent.mkdir(parents=True, exist_ok=True)
        self._lock = FileLock(path.with_name(f".{path.name}.lock"), blocking=False)
        try:
            self._lock.acquire()
        except Timeout:
            message = f"{path}: another certkit is at work on this study; wait for it or choose another --out"
            raise UsageError(message) from None
        self.known: dict[str, Outcome] = {}
        try:
            if fresh:
                path.unlink(missing_ok=True)
            elif path.exists():
                self._read(path)
            binary = getattr(os, "O_BINARY", 0)  # Windows would make \r\n of line ends
            self._file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND | binary, 0o666)
        except BaseException:
            self._lock.release()
            raise

    def _read(self, path: Path) -> None:
        sound = []
        odd = False
        with path.open("rb") as lines:
            for line in lines:
                entry = _entry(line)
                if entry is None:
                    odd = True
                    continue
                sound.append(line)
                self.known[entry["key"]] = Outcome(entry["outputs"], entry["error"])
        if odd:
            write_whole(path, b"".join(sound))

    def append(self, key: str, point: Point, outcome: Outcome) -> None:
        """Remember a finished run."""
        entry = {"key": key, "point": dict(point), "outputs": dict(outcome.outputs), "error": outcome.error}
        line = _line(entry)
        while line:
            line = line[os.write(self._file, line) :]
        self.known[key] = outcome

    def close(self) -> None:
        """Release the file and its lock."""
        os.close(self._file)
        self._lock.release()

    def __enter__(self) -> Self:
        """Use as a context."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close."""
        self.close()


def forget(path: Path) -> None:
    """Throw away what a journal holds, unless another process is at work on it; see `Journal`."""
    with Journal(path, fresh=True):
        pass


def _line(entry: Mapping[str, object]) -> bytes:
    """Return an entry with its checksum as a line."""
    text = json.dumps(entry, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return f'{text[:-1]},"{SUM}":"{_checksum(text)}"}}\n'.encode()


def _entry(line: bytes) -> dict[str, Any] | None:
    """Return what a line holds; None when it is not, byte for byte, a line as it was written."""
    try:
        entry = json.loads(line)
        entry.pop(SUM)
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return entry if _line(entry) == line else None


def _checksum(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:16]
