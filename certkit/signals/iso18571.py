"""ISO/TS 18571:2024 rating: how well one curve follows another, from 0 to 1.

Four ratings of a signal against a reference: *corridor* (share of the samples near the reference), *phase*
(time shift of best correlation), *magnitude* (difference after that shift, with dynamic time warping in a
band) and *slope*. Overall = 0.4·corridor + 0.2·(phase + magnitude + slope). Both curves are sampled at 10
kHz over the evaluation interval.

Written here because `objective-rating-metrics` takes 3.3 s to import, 16.5 s for its first call and drags
in seaborn and numba, against 0.1 s for a whole rating here. It stays the oracle of the tests: ten kinds of
pairs agree to the last digits.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
from msgspec import Struct

from certkit.errors import DataError
from certkit.reasons import Reason, UnusableError

if TYPE_CHECKING:
    from numpy.typing import NDArray

INTERVAL = 1e-4
"""Sampling interval of the method, s."""

INNER, OUTER, CORRIDOR_EXPONENT = 0.05, 0.5, 2
LARGEST_SHIFT = 0.2
MAGNITUDE_ERROR, WARPING_BAND = 0.5, 0.1
SLOPE_ERROR, SLOPE_SAMPLES = 2.0, 9
WEIGHTS = (0.4, 0.2, 0.2, 0.2)
FEWEST_SAMPLES = 20
TIE = 1e-12
"""Correlations nearer than this are equal: on a straight line all are, and rounding must not choose."""

Grade = Literal["excellent", "good", "fair", "poor"]


class Rating(Struct, frozen=True):
    """The four ratings, their weighted sum, and the grade in words."""

    corridor: float
    phase: float
    magnitude: float
    slope: float
    overall: float
    grade: Grade


def rate(reference: NDArray[np.float64], signal: NDArray[np.float64]) -> Rating:
    """Rate a signal against a reference.

    Parameters
    ----------
    reference, signal : ndarray, shape (n,)
        Both on the same time axis with 0.1 ms steps (`resampled`), in the same unit.

    Returns
    -------
    Rating

    Raises
    ------
    DataError
        When the lengths differ, there are fewer than 20 samples, a value is not finite, or the reference is
        constant.
    """
    if reference.shape != signal.shape or reference.ndim != 1:
        raise UnusableError(
            "the curves to be rated have different lengths; bring them on one time axis first",
            Reason.of("rated-lengths-differ"),
        )
    if reference.size < FEWEST_SAMPLES:
        raise UnusableError(
            f"{reference.size} samples are too few to be rated: {FEWEST_SAMPLES} at 10 kHz are "
            "needed: record longer",
            Reason.of("rated-too-short", count=reference.size, needed=FEWEST_SAMPLES),
        )
    if not (np.isfinite(reference).all() and np.isfinite(signal).all()):
        raise UnusableError(
            "a curve with values that are not numbers cannot be rated; leave it out",
            Reason.of("rated-not-finite"),
        )
    if np.ptp(reference) == 0:
        raise UnusableError(
            "the reference is constant; there is nothing to rate against: choose another",
            Reason.of("rated-constant"),
        )
    shift = best_shift(reference, signal)
    a, b = overlap(reference, signal, shift)
    limit = LARGEST_SHIFT * reference.size
    scores = (
        _corridor(reference, signal),
        max(0.0, (limit - abs(shift)) / limit),
        _magnitude(a, b),
        _slope(a, b),
    )
    overall = sum(weight * score for weight, score in zip(WEIGHTS, scores, strict=True))
    return Rating(*scores, overall, grade(overall))


def grade(overall: float) -> Grade:
    """Return the grade of an overall rating."""
    if overall > 0.94:
        return "excellent"
    if overall > 0.80:
        return "good"
    return "fair" if overall > 0.58 else "poor"


def resampled(
    time: NDArray[np.float64], values: NDArray[np.float64], start: float, end: float
) -> NDArray[np.float64]:
    """Return values every 0.1 ms from `start` to `end` (s), by straight lines between samples of shape (n,).

    Raises
    ------
    DataError
        When the curve does not cover the interval.
    """
    slack = 1e-9
    if time[0] > start + slack or time[-1] < end - slack:
        raise DataError(
            f"the curve covers {time[0] * 1e3:.6g} to {time[-1] * 1e3:.6g} ms, "
            f"not {start * 1e3:.6g} to {end * 1e3:.6g} ms"
            "; choose an interval inside of it"
        )
    axis = start + INTERVAL * np.arange(int(np.floor((end - start) / INTERVAL + 1e-6)) + 1)
    return np.asarray(np.interp(axis, time, values), dtype=np.float64)


def _corridor(reference: NDArray[np.float64], signal: NDArray[np.float64]) -> float:
    """Rate samples 1 inside the inner corridor, 0 outside the outer, on a parabola between; take the mean."""
    norm = float(np.abs(reference).max())
    inner, outer = INNER * norm, OUTER * norm
    share = np.clip((outer - np.abs(reference - signal)) / (outer - inner), 0.0, 1.0)
    return float((share**CORRIDOR_EXPONENT).mean())


def overlap(
    reference: NDArray[np.float64], signal: NDArray[np.float64], shift: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Cut both curves, shape (n,) in one unit, to the n − |shift| samples in which they overlap.

    A positive `shift`, in samples of 0.1 ms, moves the signal towards later.
    """
    if shift > 0:
        return reference[shift:], signal[:-shift]
    if shift < 0:
        return reference[:shift], signal[-shift:]
    return reference, signal


def best_shift(reference: NDArray[np.float64], signal: NDArray[np.float64]) -> int:
    """Return the shift, in samples of 0.1 ms, at which two curves of shape (n,) correlate best.

    Shifts of up to `LARGEST_SHIFT` · n are tried; the smaller one, and then left, wins a tie.
    """
    largest = int(np.floor(reference.size * LARGEST_SHIFT))
    best, best_correlation = 0, _correlation(reference, signal)
    for size in range(1, largest + 1):
        for shift in (-size, size):
            correlation = _correlation(*overlap(reference, signal, shift))
            if correlation > best_correlation + TIE:
                best, best_correlation = shift, correlation
    return best


def _correlation(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Return the correlation coefficient; -1 where a curve is constant."""
    x, y = a - a.mean(), b - b.mean()
    scale = float(np.sqrt((x @ x) * (y @ y)))
    return float(x @ y) / scale if scale > 0 else -1.0


def _magnitude(reference: NDArray[np.float64], signal: NDArray[np.float64]) -> float:
    """Rate the difference that is left when time warping has lined the curves up."""
    rows, columns = _warping_path(signal, reference)
    norm = float(np.abs(reference[columns]).sum())
    if norm == 0:
        return 0.0
    error = float(np.abs(signal[rows] - reference[columns]).sum()) / norm
    return max(0.0, (MAGNITUDE_ERROR - error) / MAGNITUDE_ERROR)


def _slope(reference: NDArray[np.float64], signal: NDArray[np.float64]) -> float:
    """Rate the difference of the slopes, each averaged over nine samples (fewer at the ends)."""
    a, b = smooth_slope(reference), smooth_slope(signal)
    norm = float(np.abs(a).sum())
    if norm == 0:
        return 0.0
    return max(0.0, (SLOPE_ERROR - float(np.abs(b - a).sum()) / norm) / SLOPE_ERROR)


def smooth_slope(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the slope of values every 0.1 ms, shape (n,), per s: a mean of nine, fewer at the ends."""
    raw = np.gradient(values, INTERVAL)
    half = SLOPE_SAMPLES // 2
    smooth = np.empty_like(raw)
    smooth[half:-half] = np.convolve(raw, np.full(SLOPE_SAMPLES, 1 / SLOPE_SAMPLES), mode="valid")
    for index in range(half):
        smooth[index] = raw[: 2 * index + 1].mean()
        smooth[-1 - index] = raw[-(2 * index + 1) :].mean()
    return smooth


def _warping_path(
    x: NDArray[np.float64], y: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the cheapest way through the squared differences of two curves of n samples, in a band.

    The band is ceil(0.1·n) − 1 wide. The costs are summed up one anti-diagonal after another, each as a
    whole; a cell (i, j) is kept in row i + j, column i.
    """
    count = x.size
    band = int(np.ceil(WARPING_BAND * count)) - 1
    total = np.full(
        (2 * count - 1, count + 1), np.inf
    )  # the last column stays infinite: column −1 of the first cell
    total[0, 0] = (x[0] - y[0]) ** 2
    for diagonal in range(1, 2 * count - 1):
        low = max(0, diagonal - count + 1, -(-(diagonal - band) // 2))
        high = min(count - 1, diagonal, (diagonal + band) // 2)
        i = np.arange(low, high + 1)
        step = total[diagonal - 1]
        best = np.minimum(step[i - 1], step[i])
        if diagonal > 1:
            best = np.minimum(best, total[diagonal - 2][i - 1])
        total[diagonal, i] = best + (x[i] - y[diagonal - i]) ** 2
    return _way_back(total, count)


def _way_back(total: NDArray[np.float64], count: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Follow the cheapest predecessors to the start; of equals, first back in x, then in y, then in both."""
    i = j = count - 1
    path = [(i, j)]
    while i or j:
        diagonal = i + j
        back_x = total[diagonal - 1, i - 1] if i else np.inf
        back_y = total[diagonal - 1, i] if j else np.inf
        back_both = total[diagonal - 2, i - 1] if i and j else np.inf
        if back_x <= back_y and back_x <= back_both:
            i -= 1
        elif back_y <= back_both:
            j -= 1
        else:
            i, j = i - 1, j - 1
        path.append((i, j))
    rows, columns = np.array(path[::-1], dtype=np.intp).T
    return rows, columns
