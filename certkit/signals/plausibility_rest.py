"""What channels show at rest, before contact: noise that two of them share, drift, hum."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

SHARED = 0.99
"""Correlation of the noise of two channels from which on they are one sensor recorded twice. That of two
amplifiers is each one's own, also where both pick up the same hum."""
LEAST = 60
"""Samples at rest that a correlation needs, and a drift."""
LEVELS = 5
"""Different values that noise has at least; a channel of fewer shows none."""
SILENT = 1e-8
"""Share of the amplitude class that a channel may swing at rest and show no noise: an amplifier's best is
1e-5, and rounding to nine digits 1e-9."""
FINE = 1e-6
"""Share of the amplitude class that a channel's digits are finer than, for noise to show: 20 bits."""
UNSTEADY = 0.12
"""Share of its largest size that a channel may swing at rest; good recordings show up to 0.082, where the
peak is small."""
DRIFT = 0.02
"""Share of its largest size that a channel may drift by until its peak, as it does at rest."""


def copies(rest: Mapping[str, NDArray[np.float64]]) -> list[tuple[str, str]]:
    """Return pairs of channels that show the same noise.

    Parameters
    ----------
    rest : mapping of str to ndarray, shape (n,)
        Not filtered, before contact, each in its unit. Second differences are compared, so that hum and drift
        do not count; in both halves by themselves, since what a filter, or a late trigger, lets through of
        the blow is at the end alone, and common to all.
    """
    noisy = {}
    for name, values in rest.items():
        if values.size < LEAST or np.unique(values).size < LEVELS:
            continue
        halves = np.diff(values[: values.size - values.size % 2].reshape(2, -1), 2)
        deviations = halves.std(axis=1, keepdims=True)
        if float(deviations.min()) > 0.0:
            noisy[name] = (halves - halves.mean(axis=1, keepdims=True)) / deviations
    names = list(noisy)
    return [
        (name, other)
        for k, name in enumerate(names)
        for other in names[k + 1 :]
        if abs(_weaker((noisy[name] * noisy[other]).mean(axis=1))) > SHARED
    ]


def _weaker(correlations: NDArray[np.float64]) -> float:
    """Return that of the two correlations which is nearer to zero; zero where their signs differ."""
    one, other = correlations.tolist()
    return min(one, other, key=abs) if one * other > 0.0 else 0.0


def is_silent(rest: NDArray[np.float64], values: NDArray[np.float64], amplitude_class: float) -> bool:
    """Tell whether a channel shows no noise at all, though its digits are fine enough to.

    Parameters
    ----------
    rest : ndarray, shape (n,)
        Not filtered, before contact.
    values : ndarray, shape (m,)
        The whole channel.
    amplitude_class : float
        In the unit of the values.
    """
    if rest.size < LEAST or float(np.ptp(rest)) > SILENT * amplitude_class:
        return False
    levels = np.unique(values)
    return levels.size > 1 and float(np.diff(levels).min()) < FINE * amplitude_class


def swing_at_rest(rest: NDArray[np.float64], peak: float) -> float | None:
    """Return the swing of a filtered channel at rest, shape (n,), as a share of its peak, if too large."""
    share = float(np.ptp(rest)) / peak if rest.size >= LEAST and peak > 0.0 else 0.0
    return share if share > UNSTEADY else None


def drift_until_peak(rest: NDArray[np.float64], samples: int, peak: float) -> float | None:
    """Return how far a channel drifts until its peak as a share of it, where that is too much.

    Parameters
    ----------
    rest : ndarray, shape (n,)
        Filtered, before contact.
    samples : int
        From the middle of the rest to the peak.
    peak : float
        Largest size.

    Returns
    -------
    float or None
        Of the straight line through the rest; None where it drifts little, or where the line explains less
        than half of what moves at rest.
    """
    if rest.size < LEAST or peak <= 0.0:
        return None
    place = np.arange(rest.size) - 0.5 * (rest.size - 1)
    slope = float((place * rest).sum() / (place * place).sum())
    line = slope * place
    moved = float(((rest - rest.mean()) ** 2).sum())
    if moved == 0.0 or float((line * line).sum()) < 0.5 * moved:
        return None
    share = slope * samples / peak
    return share if abs(share) > DRIFT else None
