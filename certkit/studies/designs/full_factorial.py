"""Full factorial: every combination of the factors' levels."""

from __future__ import annotations

from itertools import product
from math import prod
from typing import TYPE_CHECKING

from certkit.studies.check_runs import check_runs
from certkit.studies.designs.study_design import StudyDesign

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.study import Design
    from certkit.studies.factors import Factor
    from certkit.studies.points import Point


class FullFactorial(StudyDesign):
    """All combinations."""

    def points(
        self, design: Design, factors: Sequence[Factor], correlation: NDArray[np.float64] | None
    ) -> list[Point]:
        """Return its runs; `correlation`, shape (k, k), has no part in them."""
        del correlation
        return full_factorial(factors, design.levels)


def full_factorial(factors: Sequence[Factor], levels: int) -> list[Point]:
    """Take every combination of the factors' levels.

    Raises
    ------
    UsageError
        When there are too many.
    """
    grids = [factor.levels(levels) for factor in factors]
    check_runs(prod(len(grid) for grid in grids), len(factors), "full factorial")
    names = [factor.name for factor in factors]
    return [dict(zip(names, values, strict=True)) for values in product(*grids)]
