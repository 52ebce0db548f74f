"""Header lines of ISO-MME files: `Sampling interval :0.00005`."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from certkit.errors import DataError
from certkit.exchange.container import MAX_HEADER_LINES, MAX_LINE

NOVALUE = "NOVALUE"


@dataclass(frozen=True)
class Line:
    """A descriptor as it stands: its words, its value and its line."""

    descriptor: str
    value: str
    number: int


@dataclass(frozen=True)
class Header:
    """The descriptors of a file, in order; some, such as `Comments`, may come several times.

    Parameters
    ----------
    place : str
        The file as messages name it.
    lines : tuple of Line
        Descriptors.
    end : int
        Zero-based number of the first line after the header.
    """

    place: str
    lines: tuple[Line, ...]
    end: int

    def find(self, descriptor: str) -> Line | None:
        """Return the first line with that descriptor and a value; `NOVALUE` and nothing are no values."""
        wanted = _plain(descriptor)
        return next(
            (x for x in self.lines if _plain(x.descriptor) == wanted and x.value not in {"", NOVALUE}), None
        )

    def all(self, descriptor: str) -> tuple[Line, ...]:
        """Return all lines with that descriptor and a value."""
        wanted = _plain(descriptor)
        return tuple(x for x in self.lines if _plain(x.descriptor) == wanted and x.value not in {"", NOVALUE})

    def at(self, line: Line) -> str:
        """Return `file:line` for messages."""
        return f"{self.place}:{line.number}"

    def number(self, line: Line) -> float:
        """Return a line's value as a finite number.

        Raises
        ------
        DataError
            When it is none.
        """
        try:
            value = float(line.value.split()[0])
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise DataError(f"{self.at(line)}: `{line.descriptor}` is `{line.value}`; a number is needed")
        return value


def _plain(descriptor: str) -> str:
    """Bring a descriptor to the form in which editions agree: no dots, single spaces, small letters."""
    return re.sub(r"\s+", " ", descriptor.replace(".", " ")).strip().casefold()


def read_header(lines: list[str], place: str) -> Header:
    """Read descriptors up to the first line that has no colon.

    Raises
    ------
    DataError
        When a line or the header as a whole is longer than any real one.
    """
    found: list[Line] = []
    number = 0
    for number, text in enumerate(lines):
        if len(text) > MAX_LINE:
            raise DataError(
                f"{place}:{number + 1}: a line of {len(text)} characters; headers have at most {MAX_LINE}"
            )
        if not text.strip():
            continue
        descriptor, colon, value = text.partition(":")
        if not colon:
            return Header(place, tuple(found), number)
        if len(found) >= MAX_HEADER_LINES:
            raise DataError(
                f"{place}:{number + 1}: more than {MAX_HEADER_LINES} header lines; this is no ISO-MME header"
            )
        found.append(Line(descriptor.strip(), value.strip(), number + 1))
    return Header(place, tuple(found), len(lines))
