"""Latin hypercube: one run in every slice of equal probability, of each factor (McKay and others 1979)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.studies.check_runs import check_runs
from certkit.studies.designs.shares import at_shares, correlated
from certkit.studies.designs.study_design import StudyDesign

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from certkit.definitions.study import Design
    from certkit.studies.factors import Factor
    from certkit.studies.points import Point


class LatinHypercube(StudyDesign):
    """Runs by the factors' probabilities, which may correlate."""

    def points(
        self, design: Design, factors: Sequence[Factor], correlation: NDArray[np.float64] | None
    ) -> list[Point]:
        """Return its runs; the ranks of the k factors correlate by `correlation`, shape (k, k)."""
        return latin_hypercube(factors, design.runs or 1, design.seed, correlation)


def latin_hypercube(
    factors: Sequence[Factor], runs: int, seed: int, correlation: NDArray[np.float64] | None = None
) -> list[Point]:
    """Spread the runs so that each factor has one in every slice of equal probability.

    Parameters
    ----------
    factors : sequence of Factor
    runs, seed : int
    correlation : ndarray, shape (k, k), optional
        Of the factors' normal scores (a Gaussian copula); slices stay, their combination changes.
    """
    from scipy.stats import qmc  # noqa: PLC0415  # scipy is slow to import

    check_runs(runs, len(factors), "latin hypercube")
    shares = qmc.LatinHypercube(len(factors), rng=np.random.default_rng(seed)).random(runs)
    return at_shares(factors, correlated(shares, correlation))
