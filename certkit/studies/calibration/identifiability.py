"""How well the tests know the parameters: uncertainties, correlations and what they leave open."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.documents.calibration_report import OpenDirection
from certkit.studies.calibration.targets import FLAT, WITHIN

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.studies.calibration.parameter_space import Space

LEARNT = 0.8
"""Narrowed to no less than this part of its bounds' spread, a direction is left open."""

ALONE = 0.7
"""The same for a parameter. Of two that the tests see only together each is narrowed to √½ here, where
bounds are taken as normal distributions; between real bounds hardly anything is known of either.
"""

STRONG = 0.6
"""Correlations from here on are told."""


class Knowledge(Struct, frozen=True):
    """What is known of the parameters after a fit.

    Parameters
    ----------
    deviations : mapping of str to float
        Standard deviation of each parameter, in its unit, from tests, bounds and priors.
    narrowed : mapping of str to float
        That which the tests leave without priors, as a part of what the bounds alone leave: 1 is nothing
        learnt.
    covariance : ndarray, shape (k, k)
        Of the shares, priors included.
    correlations : tuple of (str, str, float)
        Strong ones, strongest first.
    open : tuple of OpenDirection
        Directions that the tests leave open, widest first.
    """

    deviations: dict[str, float]
    narrowed: dict[str, float]
    covariance: NDArray[np.float64]
    correlations: tuple[tuple[str, str, float], ...]
    open: tuple[OpenDirection, ...]

    @property
    def undetermined(self) -> list[str]:
        """Parameters of which the tests say hardly more than their bounds."""
        return [name for name, part in self.narrowed.items() if part > ALONE]


def knowledge(space: Space, shares: NDArray[np.float64], jacobian: NDArray[np.float64]) -> Knowledge:
    """Linearise at the fit.

    Every value may lie anywhere in its corridor (standard deviation `WITHIN` half-widths) and every
    parameter anywhere between its bounds (`FLAT`), which is also what makes the matrix regular. What a prior
    adds counts for deviations and correlations, not for what the tests determine.

    Parameters
    ----------
    space : Space
    shares : ndarray, shape (k,)
    jacobian : ndarray, shape (m, k)
        Of the goals' residuals, without those of the parameters.
    """
    information = jacobian.T @ jacobian / WITHIN**2
    of_tests = np.linalg.inv(information + np.eye(len(shares)) / FLAT**2)
    priors = [
        0.0 if axis.prior is None else (axis.slope(float(s)) / axis.prior[1]) ** 2
        for axis, s in zip(space.axes, shares, strict=True)
    ]
    covariance = np.linalg.inv(information + np.eye(len(shares)) / FLAT**2 + np.diag(priors))
    deviation = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(deviation, deviation)
    names = space.names
    pairs = [
        (names[i], names[j], float(correlation[i, j]))
        for i in range(len(names))
        for j in range(i)
        if abs(correlation[i, j]) >= STRONG
    ]
    spreads, vectors = np.linalg.eigh(of_tests)
    left = [
        OpenDirection(spread=float(np.sqrt(spreads[i]) / FLAT), parts=_parts(names, vectors[:, i]))
        for i in reversed(range(len(names)))
        if np.sqrt(spreads[i]) > LEARNT * FLAT
    ]
    return Knowledge(
        deviations={
            axis.name: float(d * axis.slope(float(s)))
            for axis, d, s in zip(space.axes, deviation, shares, strict=True)
        },
        narrowed={name: float(np.sqrt(v) / FLAT) for name, v in zip(names, np.diag(of_tests), strict=True)},
        covariance=np.asarray(covariance, dtype=np.float64),
        correlations=tuple(sorted(pairs, key=lambda pair: -abs(pair[2]))),
        open=tuple(left),
    )


def _parts(names: list[str], vector: NDArray[np.float64]) -> dict[str, float]:
    """Return the parameters that make up most of a direction, largest first, with a fixed sign."""
    order = np.argsort(-np.abs(vector))
    sign = 1.0 if vector[order[0]] > 0 else -1.0
    return {names[i]: float(sign * vector[i]) for i in order if abs(vector[i]) > 0.25}
