"""The assessment interval of a vehicle test: from first contact to the end of the legform's first bending.

UN R127, 02 series, 2.2: the interval ends with the last zero crossing of all femur and
tibia moments, each after its first local maximum beyond a marginal 15 N·m, within their common
zero-crossing phase; it is the same for all bones and ligaments. Where a bone moment never crosses zero, all
bone curves are shifted down together until all of them cross; the shift serves to find the interval only.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

MARGINAL_MOMENT = 15.0
"""N·m; maxima below it do not count."""
LOWERED_SHARE = 0.5
"""Share of a bone's maximum by which the curves may be lowered at most. A bone that has not come down to half
of its maximum has not ended its bending; lowering the curves to it makes an interval out of nothing. An
estimate."""
TURNING = 5.0
"""N·m by which a bone that never crosses zero has to rise again after its lowest value, so that this is a low
and not the record's end; a lowest value within it is as good as zero. Above the noise of a filtered gauge, an
estimate."""


class AssessmentInterval(Struct, frozen=True):
    """The interval and how it was found.

    Parameters
    ----------
    start, end : float
        Seconds after contact.
    decided_by : str
        The channel that crosses zero last.
    shift : float
        N·m by which all bone curves were lowered to find it; 0 where all cross by themselves.
    left_out : tuple of str
        Bone channels whose maxima all stay within the marginal moment.
    """

    start: float
    end: float
    decided_by: str
    shift: float
    left_out: tuple[str, ...]

    @property
    def reason(self) -> Reason:
        """Say where the interval ends and why."""
        details = []
        if self.shift > 0:
            details.append(Reason.of("interval-lowered", shift=self.shift))
        if self.left_out:
            left = list(self.left_out)
            details.append(Reason.of("interval-left-out", channels=left, marginal=MARGINAL_MOMENT))
        end = self.end * 1e3
        return Reason.of("assessment-interval", end=end, channel=self.decided_by, details=details)


def assessment_interval(
    time: NDArray[np.float64], moments: Mapping[str, NDArray[np.float64]]
) -> AssessmentInterval | Reason:
    """Find the assessment interval.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Seconds after first contact.
    moments : mapping of str to ndarray, shape (n,)
        Filtered bone moments, N·m, by channel.

    Returns
    -------
    AssessmentInterval or Reason
        Why there is none inside the record: no bone moment has a maximum beyond 15 N·m, one is still rising
        at the record's end, or has not come down to zero, or far enough to lower the curves to it.
    """
    begin = int(np.searchsorted(time, 0.0))
    peaks: dict[str, int] = {}
    for name, values in moments.items():
        peak = _first_maximum(values, begin)
        if peak is not None:
            peaks[name] = peak
        elif values[begin:].size and float(values[begin:].max()) > MARGINAL_MOMENT:
            value, end = float(values[-1]), float(time[-1]) * 1e3
            return Reason.of("bone-still-rising", channel=name, value=value, end=end)
    if not peaks:
        return Reason.of("bone-moments-small", marginal=MARGINAL_MOMENT)
    tops = {name: _phase_maximum(moments[name], peak) for name, peak in peaks.items()}
    for name, top in tops.items():
        unfinished = _unfinished(time, name, moments[name], top)
        if unfinished is not None:
            return unfinished
    # Lowering all curves by the highest of their lows makes the last of them touch zero.
    shift = max(0.0, *(float(moments[name][top:].min()) for name, top in tops.items()))
    ends = {name: _crossing(time, moments[name] - shift, top) for name, top in tops.items()}
    last = max(ends, key=lambda name: ends[name])
    left_out = tuple(name for name in moments if name not in peaks)
    return AssessmentInterval(0.0, ends[last], last, shift, left_out)


def _phase_maximum(values: NDArray[np.float64], peak: int) -> int:
    """Return the index of the largest value from the first maximum to the zero crossing, or to the end."""
    crossed = np.flatnonzero(values[peak:] <= 0.0)
    end = peak + int(crossed[0]) if crossed.size else values.size
    return peak + int(values[peak:end].argmax())


def _unfinished(time: NDArray[np.float64], name: str, values: NDArray[np.float64], top: int) -> Reason | None:
    """Return why a bone's first bending, with its largest value at `top`, does not end inside the record."""
    at = top + int(values[top:].argmin())
    low, highest = float(values[at]), float(values[top])
    if low <= 0.0:
        return None
    turned = float(values[at:].max()) - low >= TURNING
    if not turned and low > TURNING:
        return Reason.of("bone-not-back-to-zero", channel=name, value=low, end=float(time[-1]) * 1e3)
    if low > LOWERED_SHARE * highest:
        most = 100.0 * LOWERED_SHARE
        return Reason.of("bones-lowered-too-far", channel=name, shift=low, highest=highest, most=most)
    return None


def _first_maximum(values: NDArray[np.float64], begin: int) -> int | None:
    """Return the index of the first local maximum beyond the marginal moment, or None."""
    inner = values[begin + 1 : -1]
    top = (inner > MARGINAL_MOMENT) & (inner > values[begin:-2]) & (inner >= values[begin + 2 :])
    found = np.flatnonzero(top)
    return begin + 1 + int(found[0]) if found.size else None


def _crossing(time: NDArray[np.float64], values: NDArray[np.float64], peak: int) -> float:
    """Return when `values` first comes down to zero after `peak`, between samples by straight lines."""
    index = peak + int(np.argmax(values[peak:] <= 0.0))
    if index == peak:  # lowered below zero as a whole: it has crossed by then
        return float(time[peak])
    before, after = float(values[index - 1]), float(values[index])
    return float(time[index] + (time[index] - time[index - 1]) * after / (before - after))
