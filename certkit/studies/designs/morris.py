"""Morris screening: which factors matter at all, by elementary effects (Morris 1991), with SALib."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.studies.check_runs import check_runs
from certkit.studies.designs.salib import complete, problem, salib, salib_seed
from certkit.studies.designs.shares import at_shares
from certkit.studies.designs.study_design import StudyDesign

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    import pandas as pd
    from numpy.typing import NDArray

    from certkit.definitions.study import Design
    from certkit.studies.factors import Factor
    from certkit.studies.points import Point

LEVELS = 4
"""Of its grid, as Morris recommends."""


class Morris(StudyDesign):
    """Trajectories in which one factor changes at a time."""

    def points(
        self, design: Design, factors: Sequence[Factor], correlation: NDArray[np.float64] | None
    ) -> list[Point]:
        """Return its runs; `correlation`, shape (k, k), has no part in them."""
        del correlation
        return morris_design(factors, design.trajectories, design.seed)

    def indices(
        self, table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str], seed: int
    ) -> pd.DataFrame:
        """Return what its runs were made for."""
        return morris_indices(table, factors, outputs, seed)


def morris_design(factors: Sequence[Factor], trajectories: int, seed: int) -> list[Point]:
    """Return the runs of a Morris screening: trajectories × (k + 1)."""
    check_runs(trajectories * (len(factors) + 1), len(factors), "morris screening")
    sample = salib("SALib.sample.morris").sample
    return at_shares(
        factors, sample(problem(factors), trajectories, num_levels=LEVELS, seed=salib_seed(seed))
    )


def morris_indices(
    table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str], seed: int
) -> pd.DataFrame:
    """Return each factor's mean effect over its range, its strength and how far that depends on the others.

    Columns `output`, `factor`, `mean`, `strength`, `strength_interval`, `nonlinearity` (Morris' μ, μ*, σ).
    """
    import pandas as pd  # noqa: PLC0415  # slow to import

    sample = salib("SALib.sample.morris").sample
    analyze = salib("SALib.analyze.morris").analyze
    trajectories = len(table) // (len(factors) + 1)
    shares = sample(problem(factors), trajectories, num_levels=LEVELS, seed=salib_seed(seed))
    rows = []
    for output in outputs:
        y = complete(table, output)
        found = analyze(problem(factors), shares, y, num_levels=LEVELS, seed=salib_seed(seed))
        rows += [
            {
                "output": output,
                "factor": factor.name,
                "mean": float(found["mu"][i]),
                "strength": float(found["mu_star"][i]),
                "strength_interval": float(found["mu_star_conf"][i]),
                "nonlinearity": float(found["sigma"][i]),
            }
            for i, factor in enumerate(factors)
        ]
    return pd.DataFrame(rows)
