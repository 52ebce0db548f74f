"""Standard output and standard error as a command needs them: in any encoding, closed, full, or piped.

A verdict must not depend on who reads it. What cannot be written is dropped, told once on standard error
where that is possible, and the exit code stays that of the verdict.
"""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from typing import IO, Any

from certkit.plain_text import without_odd_characters

QUIET = frozenset({errno.EPIPE, errno.EBADF})
"""The reader has seen enough, or there never was one: nobody has to be told."""


class OutputStream:
    """A text stream whose writes never raise.

    Parameters
    ----------
    stream : file or None
        Python's stream; None where the descriptor was closed before the program began.
    name : str
        What it is called in a message.
    plain : bool
        Nobody's terminal: characters that steer one are replaced. On a terminal they are our own colours.
    commands : bool
        Whether GitHub reads along, which obeys lines that begin with `::`.
    """

    def __init__(self, stream: IO[str] | None, name: str, *, plain: bool, commands: bool = False) -> None:
        """Let the stream write any character, as `?` where its encoding lacks one."""
        self._stream = stream
        self._name = name
        self._plain = plain
        self._commands = commands
        self.lost: OSError | None = None
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            # Windows would write what goes into a file as cp1252, which no reader of JSON or YAML takes.
            into_file = plain and sys.platform == "win32" and "PYTHONIOENCODING" not in os.environ
            reconfigure(errors="replace", **({"encoding": "utf-8"} if into_file else {}))

    def write(self, text: str) -> int:
        """Write, or drop what cannot be written."""
        shown = without_odd_characters(text) if self._plain else text
        if self._commands:
            shown = "\n".join(_defused(line) for line in shown.split("\n"))
        self._attempt("write", shown)
        return len(text)

    def command(self, line: str) -> None:
        """Write a workflow command of our own as a line."""
        self._attempt("write", f"{line}\n")

    def flush(self) -> None:
        """Flush, or drop what cannot be written."""
        self._attempt("flush")

    def _attempt(self, what: str, *arguments: str) -> None:
        if self._stream is None or self.lost is not None:
            return
        try:
            getattr(self._stream, what)(*arguments)
        except OSError as error:
            self.lost = error
        except ValueError:  # closed by somebody else
            self.lost = OSError(errno.EBADF, "closed")

    def end(self) -> str | None:
        """Flush for the last time; return what a user should know of output that was lost."""
        self.flush()
        if self.lost is None:
            return None
        # Python flushes once more as it ends; what is left in its buffer must go somewhere.
        with contextlib.suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), self.fileno())
        return None if self.lost.errno in QUIET else f"{self._name}: {self.lost.strerror}"

    def isatty(self) -> bool:
        """Tell whether a person watches."""
        return self._stream is not None and self._stream.isatty()

    def fileno(self) -> int:
        """Return the descriptor."""
        if self._stream is None:
            raise OSError(errno.EBADF, "closed")
        return self._stream.fileno()

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401  # a stream's attributes are of any type
        """Hand on everything else."""
        return getattr(self._stream, name)


def guard_streams() -> None:
    """Put both streams behind an `OutputStream`."""
    commands = os.environ.get("GITHUB_ACTIONS") == "true"
    for name, words in (("stdout", "standard output"), ("stderr", "standard error")):
        stream = getattr(sys, name)
        plain = stream is None or not stream.isatty()
        setattr(sys, name, OutputStream(stream, words, plain=plain, commands=commands))


def end_streams() -> None:
    """Flush both, and tell what was lost where somebody may still read it."""
    if not isinstance(sys.stdout, OutputStream) or not isinstance(sys.stderr, OutputStream):
        return
    lost = sys.stdout.end()
    if lost is not None:
        sys.stderr.write(f"error: {lost}; the files are written, the exit code holds\n")
    sys.stderr.end()


def _defused(line: str) -> str:
    """Take its meaning from a line that GitHub would obey."""
    return f" {line}" if line.lstrip().startswith(("::", "##[")) else line
