"""The journal of finished runs, one whole JSON line each: an interrupted study goes on where it was."""

from __future__ import annotations

import fcntl
import json
import os
from typing import TYPE_CHECKING, Self

from certkit.errors import UsageError
from certkit.studies.points import Outcome

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.studies.points import Point


class Journal:
    """An append-only file of outcomes by key.

    A line is written by one `write` call to a file opened for appending, so a killed process leaves at most
    one torn line at the end, which the next one cuts off. A lock keeps a second process out.

    Parameters
    ----------
    path : Path
        The file; made with its folder when missing.

    Raises
    ------
    UsageError
        When another process holds the journal.
    """

    def __init__(self, path: Path) -> None:
        """Open, lock and read the journal."""
        path.parent.mkdir(parents=True, exist_ok=True)
        self._file = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, 0o666)
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(self._file)
            message = f"{path}: another certkit is at work on this study; wait for it or choose another --out"
            raise UsageError(message) from None
        self.known: dict[str, Outcome] = {}
        self._read(path)

    def _read(self, path: Path) -> None:
        whole = 0
        with path.open("rb") as lines:
            for line in lines:
                if not line.endswith(b"\n"):
                    break
                whole += len(line)
                try:
                    entry = json.loads(line)
                    self.known[entry["key"]] = Outcome(entry["outputs"], entry["error"])
                except (ValueError, KeyError, TypeError):
                    continue  # a damaged line is a run that is not known: it is done again
        os.ftruncate(self._file, whole)

    def append(self, key: str, point: Point, outcome: Outcome) -> None:
        """Remember a finished run."""
        entry = {"key": key, "point": dict(point), "outputs": dict(outcome.outputs), "error": outcome.error}
        line = json.dumps(entry, ensure_ascii=False, allow_nan=False, separators=(",", ":")) + "\n"
        os.write(self._file, line.encode())
        self.known[key] = outcome

    def close(self) -> None:
        """Release the file and its lock."""
        os.close(self._file)

    def __enter__(self) -> Self:
        """Use as a context."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close."""
        self.close()
