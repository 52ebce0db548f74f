"""Sobol sequence: runs that fill the space evenly, scrambled (Owen 1998)."""

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


class SobolSequence(StudyDesign):
    """Runs by the factors' probabilities, which may correlate."""

    def points(
        self, design: Design, factors: Sequence[Factor], correlation: NDArray[np.float64] | None
    ) -> list[Point]:
        """Return its runs; the ranks of the k factors correlate by `correlation`, shape (k, k)."""
        return sobol_sequence(factors, design.runs or 1, design.seed, correlation)


def sobol_sequence(
    factors: Sequence[Factor], runs: int, seed: int, correlation: NDArray[np.float64] | None = None
) -> list[Point]:
    """Fill the space evenly with a scrambled Sobol sequence, rounded up to a power of two.

    The ranks of the k factors correlate by `correlation`, shape (k, k).
    """
    from scipy.stats import qmc  # noqa: PLC0415  # scipy is slow to import

    power = (runs - 1).bit_length()
    check_runs(1 << power, len(factors), "sobol sequence")
    sequence = qmc.Sobol(len(factors), rng=np.random.default_rng(seed))
    return at_shares(factors, correlated(sequence.random_base2(power), correlation))
