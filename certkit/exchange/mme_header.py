"""Header lines of ISO-MME files: `Sampling interval :0.00005`."""

from __future__ import annotations

import re
from functools import lru_cache

from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.data_units import quantity
from certkit.files.limits import MAX_HEADER_LINES, MAX_LINE

NOVALUE = "NOVALUE"

OWN_SIMULATION = "simulated by certkit"
"""Comment of a container of certkit's own simulation; what others simulated is a virtual test."""


class Line(Struct, frozen=True):
    """A descriptor as it stands: its words, its value and its line."""

    descriptor: str
    value: str
    number: int


class Header(Struct, frozen=True):
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
        """Return the line with that descriptor and a value; `NOVALUE` and nothing are no values.

        Raises
        ------
        DataError
            When it stands there several times with different values.
        """
        told = self.all(descriptor)
        if not told:
            return None
        first, *others = told
        for other in others:
            if not _same(first.value, other.value):
                raise DataError(
                    f"{self.at(other)}: `{descriptor}` is `{other.value[:60]}` here and "
                    f"`{first.value[:60]}` in line {first.number}; keep the right one"
                )
        return first

    def all(self, descriptor: str) -> tuple[Line, ...]:
        """Return all lines with that descriptor and a value."""
        wanted = _plain(descriptor)
        return tuple(
            x for x in self.lines if _plain(x.descriptor) == wanted and x.value.upper() not in {"", NOVALUE}
        )

    def at(self, line: Line) -> str:
        """Return `file:line` for messages."""
        return f"{self.place}:{line.number}"

    def quantity(self, line: Line, dimension: str, unit: str) -> float:
        """Return a line's value in SI.

        Parameters
        ----------
        line : Line
        dimension : str
            A key of `UNITS`.
        unit : str
            Of a bare number; one that stands behind the number is read.

        Raises
        ------
        DataError
            When it is no finite number, or one with a unit of another dimension.
        """
        try:
            return quantity(line.value, dimension, unit)
        except ValueError as error:
            hint = "correct it to a number" + (f" in {unit}" if unit else "")
            raise DataError(f"{self.at(line)}: `{line.descriptor}`: {error}; {hint}") from error

    def count(self, line: Line) -> int:
        """Return a line's value as a number of things.

        Raises
        ------
        DataError
            When it is no whole number.
        """
        if not re.fullmatch(r"\d{1,30}", line.value):
            raise DataError(
                f"{self.at(line)}: `{line.descriptor}` is `{line.value[:40]}`; a whole number is "
                "needed: correct it"
            )
        return int(line.value)


def _same(one: str, other: str) -> bool:
    """Tell whether two values say the same, as words or as numbers."""
    if _plain(one) == _plain(other):
        return True
    try:
        return quantity(one, "ratio") == quantity(other, "ratio")
    except ValueError:
        return False


@lru_cache(maxsize=4096)
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
                f"{place}:{number + 1}: a line of {len(text)} characters; headers have at most {MAX_LINE}: "
                "is it the right file?"
            )
        if not text.strip():
            continue
        descriptor, colon, value = text.partition(":")
        if not colon:
            return Header(place, tuple(found), number)
        if len(found) >= MAX_HEADER_LINES:
            raise DataError(
                f"{place}:{number + 1}: more than {MAX_HEADER_LINES} header lines; this is no "
                "ISO-MME header: name another file"
            )
        found.append(Line(descriptor.strip(), value.strip(), number + 1))
    return Header(place, tuple(found), len(lines))
