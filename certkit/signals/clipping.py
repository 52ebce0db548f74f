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
STEEP = ((1e-3, 3.2e-3, 1e-2, 3e-2), (60.0, 50.0, 40.0, 28.0))
"""Bands that the shoulders of the larger side have to fall by, over the band as a share of the swing (in
between by its logarithm): the wider the band, the less a smooth peak keeps it. The flattest peaks of the
shipped runs, with noise and filters, have 39 at a share of 0.001, 25 at 0.003, 32 at 0.01 and 20 at 0.03; a
peak cut at six tenths has 32 at 0.03 already."""
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
STEEP_ALONE = 150.0
"""Narrow bands that one shoulder has to fall by; the steepest flank of a shipped run has 47, with noise."""
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
    if amplitude_class is not None:
        over = np.abs(values) >= 0.9995 * amplitude_class
        both = np.flatnonzero(over[1:] & over[:-1])
        if both.size:
            return Clipping(float(values[np.argmax(np.abs(values))]), int(both[0]))
    largest = float(np.abs(values).max())
    if amplitude_class is not None and largest < SMALL * amplitude_class:
        return None
    for sign in (1.0, -1.0):
        side = sign * values
        top = float(side.max())
        if top <= 0 or top < SMALLER * largest:
            continue
        index = _flat_top(side, 1.0 if top == largest else STEEP_SMALLER)
        if index is not None:
            return Clipping(sign * top, index)
    return None


def _flat_top(values: NDArray[np.float64], times: float) -> int | None:
    """Return where a flat top begins whose shoulders fall by `times` as many bands as is steep, or None."""
    peak = int(values.argmax())
    top, swing = float(values[peak]), float(np.ptp(values))
    steps = np.abs(np.diff(values))
    steps = steps[steps > 1e-9 * swing]
    digit = float(steps.min()) if steps.size else 0.0
    bands = [share * swing for share in BANDS if share * swing > 2.5 * digit]
    # Values with few digits: one step below the top, however few bands are left.
    for band in [*([1.5 * digit] if 1.5 * digit < BANDS[-1] * swing else []), *bands]:
        outside = np.flatnonzero(values < top - band)
        cut = int(np.searchsorted(outside, peak))
        begin = int(outside[cut - 1]) + 1 if cut > 0 else 0
        end = int(outside[cut]) if cut < outside.size else values.size
        width = end - begin
        if width < FLAT_SAMPLES:
            continue
        falls = [
            _fall(top, values[:begin][::-1], width),
            _fall(top, values[end:], width),
        ]
        known = [fall for fall in falls if fall is not None]
        steep = times * float(np.interp(np.log(band / swing), np.log(STEEP[0]), STEEP[1]))
        if known and min(known) > max(steep * band, SHOULDER * swing):
            return begin
        # A dip within the flat looks like a second, shallow shoulder; the other one still tells.
        if known and band <= NARROW * swing and max(known) > max(STEEP_ALONE * band, SHOULDER * swing):
            return begin
    return None


def _fall(top: float, beside: NDArray[np.float64], width: int) -> float | None:
    """Return how far a shoulder falls within the flat's width; None where too little of it was recorded.

    Parameters
    ----------
    top : float
    beside : ndarray, shape (n,)
        Samples beside the flat, nearest first.
    width : int
        Samples of the flat.
    """
    count = min(beside.size, width)
    if count < max(1, _BESIDE * width):
        return None
    # What a parabola would fall within the samples that there are, brought to the whole width.
    share = 9.0 / (1.0 + 2.0 * count / width) ** 2
    return float(top - beside[count - 1]) * share
