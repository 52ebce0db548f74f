"""Clipping: a channel that ran into its amplitude class, or into an amplifier, has lost its peak.

Two signs are looked for: samples at the channel amplitude class (ISO 6487), and a flat top with steep
shoulders. A smooth peak is flat too, within any band d below its top; but a parabola as wide as w within the
band falls off by 9·d within another w beside it. A clipped top falls off by far more, whether its plateau is
perfectly flat, toggles by a digit, carries noise or reaches the record's end.

A channel that goes on beyond its class, as that of a ligament that has torn, was not cut off there; what
holds beyond the class is for `beyond_class` to tell. Nor is a plateau on the smaller side cut off that lasts
until the record's end: there the channel has dropped, and its peak stands before.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

FLAT_SAMPLES = 10
"""Samples that a flat top has at least."""
STEEP = ((5.6e-4, 1e-3, 5.6e-3, 1e-2, 2.2e-2, 3e-2), (97.0, 84.0, 84.0, 63.0, 42.0, 28.0))
"""Bands that the shoulders of the larger side have to fall by, over the band as a share of the swing (in
between by its logarithm): the wider the band, the less a smooth peak keeps it. The flattest peaks of the 45
legs of the shipped family in pendulum, inverse and four vehicle tests have 88 at a share of 0.0006, 75 at
0.006, 57 at 0.01, 37 at 0.022 and 25 at 0.03; a peak cut at six tenths has 32 at 0.03 already."""
AT_CLASS = 0.9995
"""Share of the amplitude class that counts as reaching it; more than its inverse has gone beyond."""
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
STEP, STEP_SAMPLES = 0.6, 2
"""Share of a shoulder's fall that a step does within so many samples; the flank of a blow takes several."""
SHOULDER = 0.02
"""Share of the channel's whole swing that the shoulders have to fall by: waves of filtered noise do not."""
_BESIDE = 0.25
"""Share of the flat's width that has to be recorded beside it to be a shoulder."""


class Clipping(Struct, frozen=True):
    """Where a channel was cut off: `level` in its SI unit, and the index of the first sample there."""

    level: float
    index: int


def find_clipping(values: NDArray[np.float64], amplitude_class: float | None = None) -> Clipping | None:
    """Look for clipped samples in one channel, SI, shape (n,); see `find_clippings`."""
    return find_clippings(values[np.newaxis], [amplitude_class])[0]


def find_clippings(
    rows: NDArray[np.float64], amplitude_classes: Sequence[float | None]
) -> list[Clipping | None]:
    """Look for clipped samples in several channels at once, which is several times as quick.

    Parameters
    ----------
    rows : ndarray, shape (channels, n)
        As recorded: offset not removed, not filtered.
    amplitude_classes : sequence of float or None
        Amplitude class of each channel; two neighbouring samples at it are clipped.

    Returns
    -------
    list of Clipping or None
        One for each channel.
    """
    found: list[Clipping | None] = [None] * len(rows)
    if rows.shape[1] < 2 * FLAT_SAMPLES:
        return found
    high, low = rows.max(axis=1), rows.min(axis=1)
    swings = high - low
    highest, lowest = high.tolist(), low.tolist()
    largest = [max(most, -least) for most, least in zip(highest, lowest, strict=True)]
    sides: list[tuple[int, float, float]] = []
    for row, limit in enumerate(amplitude_classes):
        if limit is not None:
            if AT_CLASS * limit <= largest[row] <= limit / AT_CLASS:
                found[row] = _two_neighbours(rows[row], np.abs(rows[row]) >= AT_CLASS * limit)
            if found[row] is not None or largest[row] < SMALL * limit:
                continue
        sides += [
            (row, sign, top)
            for sign, top in ((1.0, highest[row]), (-1.0, -lowest[row]))
            if top > 0 and top >= SMALLER * largest[row]
        ]
    if not sides:
        return found
    of = [row for row, _, _ in sides]
    heights = _bands(rows, swings)
    times = np.array([1.0 if top == largest[row] else STEEP_SMALLER for row, _, top in sides])
    depths = rows[of]
    depths *= np.array([[-sign] for _, sign, _ in sides])
    begins = _flat_tops(depths, heights[of], swings[of], times)
    for (row, sign, top), begin in zip(sides, begins, strict=True):
        if begin >= 0 and found[row] is None:
            found[row] = Clipping(sign * top, int(begin))
    return found


def beyond_class(values: NDArray[np.float64], limit: float) -> Clipping | None:
    """Return the largest value beyond an amplitude class, and where two neighbouring samples first are.

    ISO 6487 promises nothing of what a measuring chain shows there. A simulation has no such chain.

    Parameters
    ----------
    values : ndarray, shape (n,)
        As recorded.
    limit : float
        The amplitude class, in the unit of the values.
    """
    return _two_neighbours(values, np.abs(values) > limit / AT_CLASS)


def _two_neighbours(values: NDArray[np.float64], chosen: NDArray[np.bool_]) -> Clipping | None:
    """Return the largest value, and the first of two neighbouring samples that were chosen."""
    both = np.flatnonzero(chosen[1:] & chosen[:-1])
    return Clipping(float(values[np.abs(values).argmax()]), int(both[0])) if both.size else None


def _bands(rows: NDArray[np.float64], swings: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the heights of the bands to look at, in turn, shape (k, bands); NaN where one is left out.

    `rows` has the shape (k, n), their `swings` the shape (k,).
    """
    steps = np.diff(rows)
    np.abs(steps, out=steps)
    np.copyto(steps, np.inf, where=~(steps > 1e-9 * swings[:, np.newaxis]))
    digits = steps.min(axis=1)
    digits[~np.isfinite(digits)] = 0.0
    bands = BANDS * swings[:, np.newaxis]
    # Values with few digits: one step below the top, however few bands are left.
    first = np.where((digits > 0.0) & (1.5 * digits < bands[:, -1]), 1.5 * digits, np.nan)
    bands[bands <= 2.5 * digits[:, np.newaxis]] = np.nan
    return np.column_stack([first, bands])


def _flat_tops(
    depths: NDArray[np.float64],
    heights: NDArray[np.float64],
    swings: NDArray[np.float64],
    times: NDArray[np.float64],
) -> NDArray[np.intp]:
    """Return where flat tops begin whose shoulders fall by `times` as many bands as is steep, −1 for none.

    Parameters
    ----------
    depths : ndarray, shape (k, n)
        The values downwards, so that the peak is the lowest of them.
    heights : ndarray, shape (k, bands)
    swings, times : ndarray, shape (k,)
    """
    count = depths.shape[1]
    peaks = depths.argmin(axis=1)
    tops = depths[np.arange(len(depths)), peaks]
    # How far the values stay within each band from the peak outwards: each band has one lower end.
    left, right = _reaches(depths, peaks, tops[:, np.newaxis] + heights)
    begin, end = peaks[:, np.newaxis] + 1 - left, peaks[:, np.newaxis] + right
    widths = end - begin
    falls = (
        _falls(tops, depths[:, ::-1], count - begin, widths),
        _falls(tops, depths, end, widths),
    )
    shares, least = heights / swings[:, np.newaxis], SHOULDER * swings[:, np.newaxis]
    steep = times[:, np.newaxis] * np.interp(np.log(shares), np.log(STEEP[0]), STEEP[1])
    # A plateau of the smaller side that lasts until the record's end is what a dropped channel leaves.
    lasting = (times > 1.0)[:, np.newaxis] & np.isnan(falls[1])
    found = np.fmin(*falls) > np.maximum(steep * heights, least)
    # A dip within the flat looks like a second, shallow shoulder; the other one still tells.
    alone = (np.fmax(*falls) > np.maximum(STEEP_ALONE * heights, least)) & (shares <= NARROW)
    for row, band in np.argwhere(alone & ~found):
        side = int(falls[1][row, band] == np.fmax(falls[0][row, band], falls[1][row, band]))
        edge = depths[row, end[row, band] - 1 :] if side else depths[row, begin[row, band] :: -1]
        alone[row, band] = not _steps_down(edge[: widths[row, band] + 1])
    hits = (found | alone) & (widths >= FLAT_SAMPLES) & ~lasting
    first = hits.argmax(axis=1)
    return np.where(hits.any(axis=1), begin[np.arange(len(begin)), first], -1)


def _reaches(
    depths: NDArray[np.float64], peaks: NDArray[np.intp], floors: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the numbers of samples from the peaks to the left and right that lie above each floor gaplessly.

    Parameters
    ----------
    depths : ndarray, shape (k, n)
    peaks : ndarray, shape (k,)
        Indices of the peaks, which count on both sides.
    floors : ndarray, shape (k, bands)
        Depths, rising; those that are left out are NaN, and any number stands for them.
    """
    below = depths > floors[:, -1:]
    left, right = np.empty((2, *floors.shape), dtype=np.intp)
    deepest = np.maximum.accumulate
    for row, (depth, beyond, floor, peak) in enumerate(
        zip(depths, below, floors, peaks.tolist(), strict=True)
    ):
        last = int(beyond[peak::-1].argmax()) or peak
        left[row] = deepest(depth[peak - last : peak + 1][::-1]).searchsorted(floor, side="right")
        last = int(beyond[peak:].argmax()) or depth.size
        right[row] = deepest(depth[peak : peak + last + 1]).searchsorted(floor, side="right")
    return left, right


def _steps_down(shoulder: NDArray[np.float64]) -> bool:
    """Tell whether a shoulder, its depths of shape (n,) from the flat's edge outwards, falls by a step.

    No flank of a blow that was cut off does; a sensor that was torn off may.
    """
    jumps = shoulder[STEP_SAMPLES:] - shoulder[:-STEP_SAMPLES]
    return bool(jumps.size and jumps.max() > STEP * (shoulder[-1] - shoulder[0]))


def _falls(
    tops: NDArray[np.float64], depths: NDArray[np.float64], ends: NDArray[np.intp], widths: NDArray[np.intp]
) -> NDArray[np.float64]:
    """Return how far the shoulder behind each flat falls within its width; NaN where too little was recorded.

    Parameters
    ----------
    tops : ndarray, shape (k,)
    depths : ndarray, shape (k, n)
        The channels, in the direction in which the shoulder is looked at.
    ends : ndarray, shape (k, bands)
        Index of the first sample beside each flat.
    widths : ndarray, shape (k, bands)
        Samples of each flat.
    """
    counts = np.minimum(depths.shape[1] - ends, widths)
    # What a parabola would fall within the samples that there are, brought to the whole width.
    shares = 9.0 / (1.0 + 2.0 * counts / widths) ** 2
    behind = np.minimum(ends + counts, depths.shape[1]) - 1
    falls = (depths[np.arange(len(depths))[:, np.newaxis], behind] - tops[:, np.newaxis]) * shares
    return np.where(counts < np.maximum(1, _BESIDE * widths), np.nan, falls)
