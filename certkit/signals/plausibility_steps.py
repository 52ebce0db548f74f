"""Drop-outs and overflows: steps from one sample to the next that no leg and no filter lets through."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

CORNER = 300.0
"""Hertz that a filter of class 180 lets through (ISO 6487); what a criterion is measured on holds no more."""
SHORTEST = 1e-4
"""Seconds over which a rate counts. Quicker recordings may step as far as within that time: what lies above
the corner frequency is small, but quick."""
NOISE_FACTOR = 8.0
"""Standard deviations of the noise that a step may have on top; among 1e6 samples none has eight."""
LIGAMENT_SPEED = 11.1
"""Metres a second: the speed of every impact. No ligament is lengthened faster than the leg is hit (the
steepest flank of a shipped run has 3.7)."""

AWAY = 0.1
"""Share of its own swing that a channel has to jump within one sample, there and back, to have dropped out;
the shipped runs with noise, one of which is hit right at a gauge, show up to 0.034."""
SPIKE = 0.001
"""Seconds within which a jump there and back is a drop-out whatever lies between: a half wave of 500 Hz and
more, of which a filter of class 180 leaves less than a third."""
RETURN = 0.5
"""Share of the jump by which the values before and after a spike may differ."""
GAP = 0.010
"""Seconds within which a jump there and back is a drop-out when the values between stand still."""
STILL = 0.05
"""Share of the jump that the values in a gap may move, beside noise."""


def steepest(amplitude_class: float) -> float:
    """Return the largest rate that a bending moment can have, N·m/s.

    It is that of a swing over the whole amplitude class A at the corner frequency f of CFC 180:
    2 π f · A/2, 377 N·m/ms for 400 N·m: 37.7 N·m within a tenth of a millisecond. The steepest of the shipped
    runs, where a bumper hits right at a gauge, has 24 N·m.
    """
    return math.pi * CORNER * amplitude_class


def largest_step(interval: float, rate: float) -> float:
    """Return the largest step that a rate allows from one sample to the next, without noise."""
    return rate * max(interval, SHORTEST)


def noise_of_steps(values: NDArray[np.float64]) -> float:
    """Return the standard deviation of a step that noise alone makes, in the unit of `values`, shape (n,).

    It is read from the median second difference.
    For white noise of deviation s, steps have s·√2 and second differences s·√6; the median of their size is
    0.6745 of their deviation and does not see a few large ones.
    """
    if values.size < 3:
        return 0.0
    return float(np.median(np.abs(np.diff(values, 2)))) / 0.6745 / math.sqrt(3.0)


def impossible_step(values: NDArray[np.float64], interval: float, rate: float) -> int | None:
    """Return where the largest impossible step ends, or None when all steps are possible.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Not filtered.
    interval : float
        Seconds between samples.
    rate : float
        Largest possible rate, in the unit of the values per second.
    """
    if values.size < 2:
        return None
    steps = np.abs(np.diff(values))
    at = int(steps.argmax())
    limit = largest_step(interval, rate)
    if steps[at] <= limit:  # the quick way out: nearly every channel leaves here
        return None
    return at + 1 if steps[at] > limit + NOISE_FACTOR * noise_of_steps(values) else None


def drop_out(values: NDArray[np.float64], interval: float, swing: float) -> tuple[int, int] | None:
    """Return where a channel jumps away from its course and where it is back; None where it never does.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Not filtered.
    interval : float
        Seconds between samples.
    swing : float
        How far the channel moves in the test, in the unit of the values.

    Returns
    -------
    tuple of int or None
        Index of the first sample that is off, and of the first that is back, of the first drop-out.
    """
    if values.size < 3 or swing <= 0.0:
        return None
    steps = np.diff(values)
    large = np.flatnonzero(np.abs(steps) > AWAY * swing)
    if large.size < 2:  # the quick way out: nearly every channel leaves here
        return None
    noise = noise_of_steps(values)
    large = large[np.abs(steps[large]) > AWAY * swing + NOISE_FACTOR * noise]
    for first, second in pairwise(large):
        if steps[first] * steps[second] >= 0.0:
            continue
        jump = min(abs(float(steps[first])), abs(float(steps[second])))
        seconds = (second - first) * interval
        between = values[first + 1 : second + 1]
        back = abs(float(values[second + 1] - values[first])) < RETURN * jump
        still = between.size > 1 and float(np.ptp(between)) < STILL * jump + NOISE_FACTOR * noise
        if (seconds <= SPIKE and back) or (seconds <= GAP and still):
            return int(first) + 1, int(second) + 1
    return None
