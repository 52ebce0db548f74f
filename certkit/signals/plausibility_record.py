"""Whether a peak lies inside what was recorded: edges, a record that begins late or ends early.

A largest value at the first or last sample is a flank, not a peak. All arrays are signed in the direction
that is measured, so that the peak is their largest value.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

EDGE = 0.0005
"""Seconds beside an edge in which a peak has to stand out from the edge; a filter of class 180 (300 Hz) moves
a flank's largest value by less."""
STANDING_OUT = 0.005
"""Share of the peak by which it has to exceed the edge beside it; a parabola of 20 ms falls by as much in
half a millisecond. An estimate."""
BEGIN_TOLERANCE = 0.001
"""Seconds that a record may begin after contact: no gauge of a shipped run has half its peak by then."""
EARLY_SHARE = 0.25
"""Share of the peak that a channel may show before contact or at the first sample. An estimate: offsets and
swinging stay below, a record that begins on a flank does not."""
EARLY_CLASS = 0.05
"""The same as a share of the amplitude class, for channels hardly loaded (20 N·m; in free flight: 15)."""
END_SHARE = 0.5
"""Share of the peak below which a channel has to have fallen at the record's end. Between two humps no
graded channel of a shipped run falls below it and then rises above its first peak. An estimate."""
RISING_SHARE = 0.25
"""The same for a channel that is still rising there. An estimate."""
LAST = 0.001
"""Seconds over which the last values are averaged."""
RISE = 0.01
"""Share of the peak by which a channel rises from one millisecond to the next to be rising, above noise."""


def edge_of_peak(values: NDArray[np.float64], index: int, interval: float) -> Literal["first", "last"] | None:
    """Return the edge that the largest value stands at, or None when it stands out from both.

    Parameters
    ----------
    values : ndarray, shape (n,)
        In the channel's unit, turned so that the peak is the largest one.
    index : int
        Of the largest value.
    interval : float
        Seconds between samples.
    """
    guard = max(1, round(EDGE / interval)) if interval > 0 else 1
    least = STANDING_OUT * abs(float(values[index]))
    last = values.size - 1
    if index == last or (last - index < guard and float(values[index] - values[last]) < least):
        return "last"
    if index == 0 or (index < guard and float(values[index] - values[0]) < least):
        return "first"
    return None


def level_at_end(values: NDArray[np.float64], peak: float, interval: float) -> float | None:
    """Return the share of the peak at the end, where it is too large to know that the peak is over.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Up to the end.
    peak : float
        Above zero.
    interval : float
        Seconds between samples.

    Returns
    -------
    float or None
        None where the channel has fallen far enough.
    """
    count = max(1, round(LAST / interval)) if interval > 0 else 1
    last = float(values[-count:].mean()) / peak
    if last > END_SHARE:
        return last
    before = values[-2 * count : -count]
    rising = before.size > 0 and last - float(before.mean()) / peak > RISE
    return last if rising and last > RISING_SHARE else None


def loaded_before(
    values: NDArray[np.float64], contact: int, peak: float, amplitude_class: float
) -> float | None:
    """Return the largest value at and before contact, where it is no value of a leg at rest.

    Parameters
    ----------
    values : ndarray, shape (n,)
        The whole record, either sign.
    contact : int
        Index of contact; the first sample of a record that begins with it.
    peak : float
        Largest size of the channel after contact.
    amplitude_class : float
        Channel amplitude class, in the channel's unit.
    """
    early = values[: contact + 1]
    if not early.size:
        return None
    found = float(early[abs(early).argmax()])
    return found if abs(found) > max(EARLY_SHARE * peak, EARLY_CLASS * amplitude_class) else None
