"""Clipping: a channel that ran into its amplitude class, or into an amplifier, has lost its peak.

Two signs are looked for: samples at the channel amplitude class (ISO 6487), and a flat top with steep
shoulders. A smooth peak read with few digits is flat too, but falls off by about nine digit steps within
its own width beside the flat; a clipped one falls off by far more.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_FLAT_SAMPLES = 10
_STEEP = 50.0  # digit steps


@dataclass(frozen=True)
class Clipping:
    """Where a channel was cut off: `level` in its SI unit, and the index of the first sample there."""

    level: float
    index: int


def find_clipping(values: NDArray[np.float64], amplitude_class: float | None = None) -> Clipping | None:
    """Look for clipped samples.

    Parameters
    ----------
    values : ndarray, shape (n,)
        As recorded: offset not removed, not filtered.
    amplitude_class : float, optional
        The channel's amplitude class; two neighbouring samples at it are clipped.

    Returns
    -------
    Clipping or None
    """
    if values.size < 2 * _FLAT_SAMPLES:
        return None
    if amplitude_class is not None:
        over = np.abs(values) >= 0.9995 * amplitude_class
        both = np.flatnonzero(over[1:] & over[:-1])
        if both.size:
            return Clipping(float(values[np.argmax(np.abs(values))]), int(both[0]))
    for level in (float(values.max()), float(values.min())):
        index = _flat_top(values, level)
        if index is not None:
            return Clipping(level, index)
    return None


def _flat_top(values: NDArray[np.float64], level: float) -> int | None:
    """Return where a flat top with steep shoulders begins at the extreme `level`, or None."""
    begin, width = _longest_run(values == level)
    if width < _FLAT_SAMPLES or begin < width or begin + 2 * width > values.size:
        return None
    steps = np.abs(np.diff(values))
    steps = steps[steps > 0]
    if not steps.size:
        return None
    digit = float(steps.min())
    shoulders = min(
        abs(level - float(values[begin - width])), abs(level - float(values[begin + 2 * width - 1]))
    )
    # Noise-free records have vanishing steps somewhere; a real shoulder is also a part of the whole swing.
    swing = float(values.max() - values.min())
    return begin if shoulders > max(_STEEP * digit, 0.02 * swing) else None


def _longest_run(flags: NDArray[np.bool_]) -> tuple[int, int]:
    """Return begin and length of the longest run of true."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(np.int8)))
    begins, ends = edges[::2], edges[1::2]
    if not begins.size:
        return 0, 0
    longest = int(np.argmax(ends - begins))
    return int(begins[longest]), int(ends[longest] - begins[longest])
