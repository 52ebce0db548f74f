"""Which of the things that a figure can show were asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence


def chosen(wanted: Sequence[str], known: Collection[str], noun: str = "") -> list[str]:
    """Return the names that are wanted, or all that there are.

    Raises
    ------
    UsageError
        When one is not there.
    """
    for name in wanted:
        if name not in known:
            what = f"no {noun} `{name}`" if noun else f"no `{name}` to draw"
            raise UsageError(f"there is {what}; there are {', '.join(known) or 'none'}")
    return list(wanted) or list(known)
