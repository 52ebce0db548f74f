"""One at a time: each factor varies alone, the others stay at their middle."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from certkit.studies.check_runs import check_runs
from certkit.studies.designs.study_design import StudyDesign
from certkit.studies.effects import coded

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd
    from numpy.typing import NDArray

    from certkit.definitions.study import Design
    from certkit.studies.factors import Factor
    from certkit.studies.points import Point


class OneAtATime(StudyDesign):
    """Effects are exact differences of runs; no model is fitted."""

    fits_models: ClassVar = False

    def points(
        self, design: Design, factors: Sequence[Factor], correlation: NDArray[np.float64] | None
    ) -> list[Point]:
        """Return its runs; `correlation`, shape (k, k), has no part in them."""
        del correlation
        return one_at_a_time(factors, design.levels)

    def effects(self, table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str]) -> pd.DataFrame:
        """Return the effects as differences; see `one_at_a_time_effects`."""
        return one_at_a_time_effects(table, factors, outputs)


def one_at_a_time(factors: Sequence[Factor], levels: int) -> list[Point]:
    """Vary each factor alone over its levels, the others at their middle; the first run is the middle."""
    check_runs(1 + len(factors) * levels, len(factors), "study of one at a time")
    middle: dict[str, float | str] = {factor.name: factor.middle for factor in factors}
    varied = [
        {**middle, factor.name: value}
        for factor in factors
        for value in factor.levels(levels)
        if value != factor.middle
    ]
    return [middle, *varied]


def one_at_a_time_effects(
    table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str]
) -> pd.DataFrame:
    """Read the effects off a one-at-a-time design: exact differences of runs, no fit.

    Returns
    -------
    DataFrame
        Columns `output`, `factor`, `effect` (value at the highest minus value at the lowest setting),
        `lower`, `upper` (values at the lowest and at the highest setting, minus the value in the middle),
        `share` (of the sum of squared effects).
    """
    import pandas as pd  # noqa: PLC0415  # slow to import

    rows = []
    for output in outputs:
        found = []
        for factor in factors:
            others = [f.name for f in factors if f is not factor]
            middle = table.iloc[0]
            alone = table[(table[others] == middle[others]).all(axis=1) & table[output].notna()]
            if len(alone) < 2 or np.isnan(middle[output]):
                continue
            position = coded(alone, [factor])[:, 0]
            values = alone[output].to_numpy(dtype=np.float64)
            low, high = values[position.argmin()], values[position.argmax()]
            found.append((factor.name, high - low, low - middle[output], high - middle[output]))
        total = sum(effect**2 for _, effect, _, _ in found)
        rows += [
            {
                "output": output,
                "factor": name,
                "effect": float(effect),
                "lower": float(low),
                "upper": float(high),
                "share": float(effect**2 / total) if total > 0 else 0.0,
            }
            for name, effect, low, high in found
        ]
    return pd.DataFrame(rows, columns=["output", "factor", "effect", "lower", "upper", "share"])
