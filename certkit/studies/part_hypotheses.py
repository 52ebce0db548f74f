"""One part changed at a time: which change explains a recording best, and how far it is known.

A recording y and the model f(0) are compared at places a filter's memory apart, so that noise is nearly
independent. Its covariance is C = σ² (noise of each sample) + g² y yᵀ for each channel (a sensor's gain) +
τ² ẏ ẏᵀ over all channels (time zero). For one part alone, the change x minimises

    χ²(x) = (y − f(x))ᵀ C⁻¹ (y − f(x)) + (x / x₀)²,

x₀ being what the part usually differs by, by Gauss and Newton with s = ∂f/∂x from the model; its standard
uncertainty is (sᵀC⁻¹s + 1/x₀²)^(−1/2), widened by √(χ²/n) where the best part leaves more than the
uncertainties explain.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Self

import numpy as np
from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

STEPS = 3
"""Of Gauss and Newton; the model is nearly straight within what parts differ by."""
ENOUGH = 0.02
"""A step below this part of the standard uncertainty ends the search."""
TOLD_APART = 6.0
"""Parts whose χ² differ by less are not told apart: a likelihood ratio of twenty."""
DEVIATES = 9.0
"""χ² that a part has to take away before a leg counts as deviating: three standard deviations."""
FARTHEST = 3.0
"""Times what is usual that a part is let differ by; one that wants more stands for something else."""
SIGMAS = 4.0
"""Standard deviations of χ² by which what is left may be more than the samples: then it is no noise."""


class Compared(Struct, frozen=True):
    """Recorded curves at the places where they are compared, with their uncertainties. SI units.

    Parameters
    ----------
    values : mapping of str to ndarray, shape (n,)
        By channel.
    slopes : mapping of str to ndarray, shape (n,)
        Their time derivatives.
    noise : mapping of str to float
        Standard uncertainty of a sample, by channel.
    gain : float
        Standard uncertainty of a sensor's gain, a share.
    trigger : float
        Standard uncertainty of time zero, s.
    """

    values: Mapping[str, NDArray[np.float64]]
    slopes: Mapping[str, NDArray[np.float64]]
    noise: Mapping[str, float]
    gain: float
    trigger: float

    def stacked(self, curves: Mapping[str, NDArray[np.float64]]) -> NDArray[np.float64]:
        """Return curves one after the other, each in units of its noise: shape (m,) from (n,) each, SI."""
        return np.concatenate([curves[name] / self.noise[name] for name in self.values])

    def inverse_covariance(self) -> NDArray[np.float64]:
        """Return C⁻¹ of the m stacked samples, shape (m, m), without unit."""
        size = sum(row.size for row in self.values.values())
        covariance = np.eye(size)
        start = 0
        for name, row in self.values.items():
            scaled = self.gain * row / self.noise[name]
            block = slice(start, start + row.size)
            covariance[block, block] += np.outer(scaled, scaled)
            start += row.size
        moved = self.trigger * self.stacked(self.slopes)
        return np.asarray(np.linalg.inv(covariance + np.outer(moved, moved)), dtype=np.float64)

    def is_noise(self, curves: Mapping[str, NDArray[np.float64]]) -> bool:
        """Tell whether what curves (SI, shape (n,) each) leave is what the uncertainties explain, everywhere.

        Each channel is looked at by itself, with C's block of it: a gauge that reads wrongly is one of many.
        """
        for name, row in self.values.items():
            gain, moved = (
                self.gain * row / self.noise[name],
                self.trigger * self.slopes[name] / self.noise[name],
            )
            block = np.eye(row.size) + np.outer(gain, gain) + np.outer(moved, moved)
            left = (row - curves[name]) / self.noise[name]
            if float(left @ np.linalg.solve(block, left)) > row.size + SIGMAS * (2 * row.size) ** 0.5:
                return False
        return True


class PartFit(Struct, frozen=True):
    """The best change of one part.

    Parameters
    ----------
    change : float
        As a share, or SI.
    deviation : float
        Its standard uncertainty, not widened.
    misfit : float
        χ² that is left, without the pull of what is usual.
    curves : mapping of str to ndarray
        Of the model with that change.
    """

    change: float
    deviation: float
    misfit: float
    curves: Mapping[str, NDArray[np.float64]]


class PartHypothesis(Struct, frozen=True):
    """One part alone, with what the model says of it.

    Parameters
    ----------
    model : callable
        Curves for a change of the part.
    unchanged : mapping of str to ndarray
        Its curves for none.
    slope : mapping of str to ndarray
        Their derivative by the change.
    usual : float
        By how much the part usually differs.
    """

    model: Callable[[float], Mapping[str, NDArray[np.float64]]]
    unchanged: Mapping[str, NDArray[np.float64]]
    slope: Mapping[str, NDArray[np.float64]]
    usual: float

    @classmethod
    def probed(
        cls,
        model: Callable[[float], Mapping[str, NDArray[np.float64]]],
        unchanged: Mapping[str, NDArray[np.float64]],
        usual: float,
    ) -> Self:
        """Take the derivative from a change of half of what is usual, to both sides.

        Curves are SI, by channel, shape (n,) each.
        """
        up, down = model(usual / 2), model(-usual / 2)
        return cls(model, unchanged, {name: (up[name] - down[name]) / usual for name in up}, usual)

    def straight(self, compared: Compared, weights: NDArray[np.float64]) -> PartFit:
        """Return the best change as if the model were straight; without running it.

        `weights` are C⁻¹, shape (m, m).
        """
        left = compared.stacked(compared.values) - compared.stacked(self.unchanged)
        slope = compared.stacked(self.slope)
        curvature = float(slope @ weights @ slope) + self.usual**-2
        change = float(slope @ weights @ left) / curvature
        curves = {name: row + change * self.slope[name] for name, row in self.unchanged.items()}
        return PartFit(change, curvature**-0.5, misfit_of(curves, compared, weights), curves)

    def refined(self, first: PartFit, compared: Compared, weights: NDArray[np.float64]) -> PartFit:
        """Return the best change by running the model at it; no farther off than `FARTHEST`.

        `weights` are C⁻¹, shape (m, m).
        """
        target, slope = compared.stacked(compared.values), compared.stacked(self.slope)
        most = FARTHEST * self.usual
        change, curves = max(-most, min(most, first.change)), first.curves
        for _ in range(STEPS):
            curves = self.model(change)
            left = target - compared.stacked(curves)
            step = (float(slope @ weights @ left) - change * self.usual**-2) * first.deviation**2
            if abs(step) < ENOUGH * first.deviation:
                break
            change = max(-most, min(most, change + step))
        return PartFit(change, first.deviation, misfit_of(curves, compared, weights), curves)

    def takes_away(
        self, best: PartHypothesis, fit: PartFit, compared: Compared, weights: NDArray[np.float64]
    ) -> float:
        """Return the χ² that this part takes away besides, where the best one is let go along with it.

        (sᵀC⁻¹r)² / (sᵀC⁻¹s − (sᵀC⁻¹b)²/(bᵀC⁻¹b + 1/x_b²) + 1/x₀²), with what is left r, and slopes s and b.
        `weights` are C⁻¹, shape (m, m).
        """
        own, other = compared.stacked(self.slope), compared.stacked(best.slope)
        left = compared.stacked(compared.values) - compared.stacked(fit.curves)
        shared = float(own @ weights @ other) ** 2 / (float(other @ weights @ other) + best.usual**-2)
        return float(own @ weights @ left) ** 2 / (float(own @ weights @ own) - shared + self.usual**-2)


def misfit_of(
    curves: Mapping[str, NDArray[np.float64]], compared: Compared, weights: NDArray[np.float64]
) -> float:
    """Return χ² of curves (SI, shape (n,) each) against the recording; `weights` are C⁻¹, shape (m, m)."""
    left = compared.stacked(compared.values) - compared.stacked(curves)
    return float(left @ weights @ left)
