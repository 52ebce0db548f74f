"""Offset removal: what a sensor shows while the legform is at rest is taken off the whole channel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

MARGIN = 0.002
"""The quiet interval ends this long before contact, s, so that an early trigger does not get into it."""
SHORTEST = 0.005
"""A quiet interval shorter than this says nothing, s."""


def quiet_interval(time: NDArray[np.float64], until: float) -> slice | None:
    """Return which samples lie between the record's start and `until`, s; None where that is less than 5 ms.

    `time`, s, has the shape (n,).
    """
    end = int(np.searchsorted(time, until))
    if end < 2 or time[end - 1] - time[0] < SHORTEST * (1 - 1e-9):
        return None
    return slice(0, end)


def remove_offset(values: NDArray[np.float64], quiet: slice) -> tuple[NDArray[np.float64], float]:
    """Subtract the mean over the quiet interval.

    Parameters
    ----------
    values : ndarray, shape (n,)
    quiet : slice
        From `quiet_interval`.

    Returns
    -------
    values : ndarray, shape (n,)
        Without the offset.
    offset : float
        What was taken off, in the unit of the values.
    """
    offset = float(values[quiet].mean())
    return values - offset, offset
