"""Clipping: a channel that ran into its amplitude class, or into an amplifier, has lost its peak.

Two signs are looked for: samples at the channel amplitude class (ISO 6487), and a flat top with steep
shoulders. A smooth peak is flat too, within any band d below its top; but a parabola as wide as w within the
band falls off by 9·d within another w beside it. A clipped top falls off by far more, whether its plateau is
perfectly flat, toggles by a digit, carries noise or reaches the record's end.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

FLAT_SAMPLES = 10
"""Samples that a flat top has at least."""
STEEP = ((5.6e-4, 1e-3, 5.6e-3, 1e-2, 2.2e-2, 3e-2), (97.0, 84.0, 84.0, 63.0, 42.0, 28.0))
"""Bands that the shoulders of the larger side have to fall by, over the band as a share of the swing (in
between by its logarithm): the wider the band, the less a smooth peak keeps it. The flattest peaks of the 45
legs of the shipped family in pendulum, inverse and four vehicle tests have 88 at a share of 0.0006, 75 at
0.006, 57 at 0.01, 37 at 0.022 and 25 at 0.03; a peak cut at six tenths has 32 at 0.03 already."""
STEEP_SMALLER = 2.0
"""Times as many bands for the smaller side; a swing of two humps has 38 at 0.001 there in a shipped run."""
SMALL = 0.115
"""Share of the amplitude class that a channel has to reach for its shape to be looked at: 3.45 mm, just below
the smallest lower limit of a corridor (PCL, 3.5 mm)."""
SMALLER = 0.2
"""Share of the largest size that the smaller side has to reach to be looked at."""
BANDS = 10.0 ** np.linspace(-4.5, -1.4, 13)
"""Heights of the band below the top, as shares of the channel's whole swing."""
NARROW = 1e-3
"""Share of the swing up to which one steep shoulder is enough: so near its top every peak is a parabola."""
STEEP_ALONE = 190.0
"""Narrow bands that one shoulder has to fall by; the steepest flank of the family's legs has 175."""
SHOULDER = 0.02
"""Share of the channel's whole swing that the shoulders have to fall by: waves of filtered noise do not."""
_BESIDE = 0.25
"""Share of the flat's width that has to be recorded beside it to be a shoulder."""


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
    if values.size < 2 * FLAT_SAMPLES:
        return None
    size = np.abs(values)
    largest = float(size.max())
    if amplitude_class is not None:
        over = size >= 0.9995 * amplitude_class if largest >= 0.9995 * amplitude_class else size[:0] > 0
        both = np.flatnonzero(over[1:] & over[:-1])
        if both.size:
            return Clipping(float(values[np.argmax(size)]), int(both[0]))
        if largest < SMALL * amplitude_class:
            return None
    heights, swing = _bands(values)
    for sign in (1.0, -1.0):
        side = sign * values
        top = float(side.max())
        if top <= 0 or top < SMALLER * largest:
            continue
        index = _flat_top(side, heights, swing, 1.0 if top == largest else STEEP_SMALLER)
        if index is not None:
            return Clipping(sign * top, index)
    return None


def _bands(values: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """Return the heights of the bands to look at, in turn, and the channel's whole swing."""
    swing = float(np.ptp(values))
    steps = np.abs(np.diff(values))
    steps = steps[steps > 1e-9 * swing]
    digit = float(steps.min()) if steps.size else 0.0
    bands = BANDS * swing
    # Values with few digits: one step below the top, however few bands are left.
    first = [1.5 * digit] if 1.5 * digit < bands[-1] else []
    return np.concatenate([first, bands[bands > 2.5 * digit]]), swing


def _flat_top(
    values: NDArray[np.float64], heights: NDArray[np.float64], swing: float, times: float
) -> int | None:
    """Return where a flat top begins whose shoulders fall by `times` as many bands as is steep, or None."""
    peak = int(values.argmax())
    top = float(values[peak])
    # How far the lowest value falls from the peak outwards: it crosses each band's lower end once.
    lows = heights - top
    begin = peak + 1 - np.searchsorted(-np.minimum.accumulate(values[peak::-1]), lows, side="right")
    end = peak + np.searchsorted(-np.minimum.accumulate(values[peak:]), lows, side="right")
    wide = np.flatnonzero(end - begin >= FLAT_SAMPLES)
    if not wide.size:
        return None
    begin, end, heights = begin[wide], end[wide], heights[wide]
    left, right = (
        _falls(top, values[::-1], values.size - begin, end - begin),
        _falls(top, values, end, end - begin),
    )
    steep = times * np.interp(np.log(heights / swing), np.log(STEEP[0]), STEEP[1])
    found = np.fmin(left, right) > np.maximum(steep * heights, SHOULDER * swing)
    # A dip within the flat looks like a second, shallow shoulder; the other one still tells.
    alone = np.fmax(left, right) > np.maximum(STEEP_ALONE * heights, SHOULDER * swing)
    hits = np.flatnonzero(found | (alone & (heights <= NARROW * swing)))
    return int(begin[hits[0]]) if hits.size else None


def _falls(
    top: float, values: NDArray[np.float64], ends: NDArray[np.intp], widths: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Return how far the shoulder behind each flat falls within its width; NaN where too little was recorded.

    Parameters
    ----------
    top : float
    values : ndarray, shape (n,)
        The channel, in the direction in which the shoulder is looked at.
    ends : ndarray, shape (k,)
        Index of the first sample beside each flat.
    widths : ndarray, shape (k,)
        Samples of each flat.
    """
    counts = np.minimum(values.size - ends, widths)
    # What a parabola would fall within the samples that there are, brought to the whole width.
    shares = 9.0 / (1.0 + 2.0 * counts / widths) ** 2
    falls = (top - values[np.minimum(ends + counts, values.size) - 1]) * shares
    return np.where(counts < np.maximum(1, _BESIDE * widths), np.nan, falls)
