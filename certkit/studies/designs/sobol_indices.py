"""Sobol indices: shares of the variance, alone and with interactions (Saltelli 2010), by SALib."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.studies.check_runs import check_runs
from certkit.studies.designs.salib import complete, problem, salib, salib_seed
from certkit.studies.designs.shares import at_shares
from certkit.studies.designs.study_design import StudyDesign

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd
    from numpy.typing import NDArray

    from certkit.definitions.study import Design
    from certkit.studies.factors import Factor
    from certkit.studies.points import Point


ROUNDING = 1e-9
"""Share of an output's size by which it has to change for shares of its variance to mean something: below,
it is the rounding of its last digits that varies."""


class SobolIndices(StudyDesign):
    """Two sample matrices and their mixtures."""

    def points(
        self, design: Design, factors: Sequence[Factor], correlation: NDArray[np.float64] | None
    ) -> list[Point]:
        """Return its runs; `correlation`, shape (k, k), has no part in them."""
        del correlation
        return sobol_design(factors, design.samples, design.seed)

    def indices(
        self, table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str], seed: int
    ) -> pd.DataFrame:
        """Return what its runs were made for."""
        return sobol_indices(table, factors, outputs, seed)


def sobol_design(factors: Sequence[Factor], samples: int, seed: int) -> list[Point]:
    """Return the runs for Sobol indices: samples × (k + 2), samples a power of two."""
    power = 1 << (samples - 1).bit_length()
    check_runs(power * (len(factors) + 2), len(factors), "study of sobol indices")
    sample = salib("SALib.sample.sobol").sample
    return at_shares(factors, sample(problem(factors), power, calc_second_order=False, seed=salib_seed(seed)))


def sobol_indices(
    table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str], seed: int
) -> pd.DataFrame:
    """Return first-order and total indices with their 95 % bootstrap intervals.

    Columns `output`, `factor`, `first`, `first_interval`, `total`, `total_interval`; intervals are
    half-widths. An output that never changes has no indices and is left out; one that changes by rounding
    only owes nothing to any factor: its indices are 0.
    """
    import pandas as pd  # noqa: PLC0415  # slow to import

    analyze = salib("SALib.analyze.sobol").analyze
    rows = []
    for output in outputs:
        y = complete(table, output)
        if np.ptp(y) == 0:
            continue
        if np.ptp(y) <= ROUNDING * float(np.max(np.abs(y))):
            none = dict.fromkeys(("first", "first_interval", "total", "total_interval"), 0.0)
            rows += [{"output": output, "factor": factor.name, **none} for factor in factors]
            continue
        found = analyze(problem(factors), y, calc_second_order=False, seed=salib_seed(seed))
        rows += [
            {
                "output": output,
                "factor": factor.name,
                "first": float(found["S1"][i]),
                "first_interval": float(found["S1_conf"][i]),
                "total": float(found["ST"][i]),
                "total_interval": float(found["ST_conf"][i]),
            }
            for i, factor in enumerate(factors)
        ]
    return pd.DataFrame(rows)
