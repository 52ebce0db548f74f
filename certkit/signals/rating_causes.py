"""Why one curve follows another badly: later or earlier, higher or lower, steeper or flatter, in numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.reasons import Reason
from certkit.signals.iso18571 import INTERVAL, LARGEST_SHIFT, OUTER, best_shift, overlap, smooth_slope

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.signals.iso18571 import Rating

LOW = 0.8
"""Ratings up to here are explained: good begins above."""


def rating_causes(
    reference: NDArray[np.float64], signal: NDArray[np.float64], rating: Rating
) -> list[Reason]:
    """Say what the parts of a rating that are not good come from.

    Parameters
    ----------
    reference, signal : ndarray, shape (n,)
        As they were rated.
    rating : Rating

    Returns
    -------
    list of Reason
        Phase: the shift of best correlation, ms; at the end of what is tried it may be larger.
        Magnitude: after that shift, the peak and the area under
        the curve's amount over the reference's. Slope: the mean steepness over the reference's. Corridor: the
        share of the time in which the curves are farther apart than half the reference's peak.
    """
    shift = best_shift(reference, signal)
    a, b = overlap(reference, signal, shift)
    causes: list[Reason] = []
    if rating.phase <= LOW and shift:
        code = "curve-early" if shift > 0 else "curve-late"
        if abs(shift) >= int(LARGEST_SHIFT * reference.size):
            code += "-or-more"
        causes.append(Reason.of(code, by=abs(shift) * INTERVAL * 1e3))
    if rating.magnitude <= LOW:
        peak = _over(float(np.abs(b).max()), float(np.abs(a).max()))
        area = _over(float(np.abs(b).sum()), float(np.abs(a).sum()))
        causes.append(Reason.of("curve-size", peak=peak, area=area))
    if rating.slope <= LOW:
        steep = float(np.abs(smooth_slope(b)).mean()), float(np.abs(smooth_slope(a)).mean())
        causes.append(Reason.of("curve-slope", times=steep[0] / steep[1] if steep[1] > 0 else 0.0))
    if rating.corridor <= LOW:
        away = np.abs(reference - signal) > OUTER * float(np.abs(reference).max())
        causes.append(Reason.of("curve-away", share=100 * float(away.mean())))
    return causes


def _over(value: float, reference: float) -> float:
    """Return the difference in per cent of the reference."""
    return 100 * (value - reference) / reference if reference > 0 else 0.0
