"""Lists of a document that have to fit together: refused where the document is read, with their place.

A document is data that somebody was sent. What renders or grades it counts on as many values as its time
axis has samples, and on numbers of a size that can be drawn.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.definitions.loading.search_path import is_name

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence, Sized

MOST_SAMPLES = 5_000_000
"""Samples of a time axis: 25 times the longest test that is recorded (200,000)."""

LARGEST_VALUE = 1e30
"""No measured or computed value in any unit of certkit comes near it, and every chart can still be scaled."""


def check_axis(start: float, interval: float, count: int) -> None:
    """Refuse a time axis that is none.

    Raises
    ------
    ValueError
        When it has no or too many samples, or does not go forward.
    """
    if not 0 <= count <= MOST_SAMPLES:
        raise ValueError(
            f"`count` is {count}; a time axis has at most {MOST_SAMPLES} samples; shorten the record"
        )
    if count > 1 and not 0 < interval < LARGEST_VALUE:
        raise ValueError(
            f"`interval` is {interval:g} s; a time axis of {count} samples goes forward"
            "; the document is damaged: make it again"
        )
    if abs(start) > LARGEST_VALUE:
        raise ValueError(f"`start` is {start:g} s; the document is damaged: make it again")


def check_lengths(expected: int, lists: Mapping[str, Sized], of: str) -> None:
    """Refuse lists that have not as many entries as they should.

    Parameters
    ----------
    expected : int
    lists : mapping of str to list
        By what they are called in the message.
    of : str
        What there are so many of: `samples`, `times`.

    Raises
    ------
    ValueError
        With the first that differs.
    """
    for name, values in lists.items():
        if len(values) != expected:
            raise ValueError(
                f"`{name}` has {len(values)} values for {expected} {of}"
                "; the document is damaged: make it again"
            )


def check_sizes(name: str, values: Sequence[float]) -> None:
    """Refuse numbers that no chart can be scaled to.

    Raises
    ------
    ValueError
        When one is beyond `LARGEST_VALUE`.
    """
    if values and (max(values) > LARGEST_VALUE or min(values) < -LARGEST_VALUE):
        raise ValueError(
            f"`{name}` has a value beyond {LARGEST_VALUE:g}; the document is damaged: make it again"
        )


def plain_name(text: str) -> str:
    """Return a name by which files and folders are called, if it leads nowhere else.

    Raises
    ------
    ValueError
        When it is no plain name.
    """
    if not is_name(text):
        raise ValueError(f"`{text[:80]}` is no plain name; letters, digits, spaces, `-` and `.` are")
    return text
