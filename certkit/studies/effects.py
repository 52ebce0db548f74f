"""Main effects: by how much, and in which direction, a parameter moves an output over its range."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.studies.factors import Levels

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd
    from numpy.typing import NDArray

    from certkit.studies.factors import Factor

CONFIDENCE = 0.95

ROUNDING = 1e-12
"""Of its size: a value that differs by less over all runs does not move, and nothing has a share in that."""


def coded(table: pd.DataFrame, factors: Sequence[Factor]) -> NDArray[np.float64]:
    """Return the factors' settings, shape (n, k), brought to −1 … 1 over each range; words by their place."""
    columns = []
    for factor in factors:
        column, distribution = table[factor.name], factor.distribution
        if isinstance(distribution, Levels):
            if any(isinstance(value, str) for value in distribution.entries):
                places = {value: float(place) for place, value in enumerate(distribution.entries)}
                numbers = np.array([places[value] for value in column])
                low, high = 0.0, float(len(places) - 1)
            else:
                numbers = column.to_numpy(dtype=np.float64)
                low, high = float(min(distribution.entries)), float(max(distribution.entries))
        else:
            numbers, low, high = column.to_numpy(dtype=np.float64), distribution.low, distribution.high
        columns.append((2 * numbers - low - high) / (high - low))
    return np.stack(columns, axis=1)


def main_effects(table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str]) -> pd.DataFrame:
    """Fit a plane through the runs; a factor's effect is its rise from the lowest to the highest value.

    Parameters
    ----------
    table : DataFrame
        From `certkit.studies.run_table`; rows without the output are left out.
    factors : sequence of Factor
    outputs : sequence of str
        Numeric columns.

    Returns
    -------
    DataFrame
        Columns `output`, `factor`, `effect`, `lower`, `upper` (95 % confidence interval by Student's t from
        the scatter around the plane; NaN where there are no more runs than coefficients), `share` (the
        variance that the factor brings along the plane, over the sum of all factors' and of the scatter
        around it). Variances of independent factors add up; in a small sample those of the runs do not quite,
        since the settings correlate a little by chance, so the sum stands below the line, not the outputs'
        variance: shares are never above 1 together.
    """
    import pandas as pd  # noqa: PLC0415  # slow to import
    from scipy.stats import t as student  # noqa: PLC0415  # slow to import

    rows = []
    for output in outputs:
        known = table[table[output].notna()]
        if len(known) <= len(factors):
            continue
        x = np.hstack([np.ones((len(known), 1)), coded(known, factors)])
        y = known[output].to_numpy(dtype=np.float64)
        slopes, _, rank, _ = np.linalg.lstsq(x, y, rcond=None)
        freedom = len(known) - int(rank)
        residual = y - x @ slopes
        variance = float(residual @ residual) / freedom if freedom > 0 else np.nan
        spread = np.sqrt(np.clip(np.diag(np.linalg.pinv(x.T @ x)), 0, None) * variance)
        reach = spread * float(student.ppf((1 + CONFIDENCE) / 2, freedom)) if freedom > 0 else spread
        explained = slopes[1:] ** 2 * np.var(x[:, 1:], axis=0)
        total = float(explained.sum() + np.mean(residual**2))
        moved = np.ptp(y) > ROUNDING * np.abs(y).max()
        for index, factor in enumerate(factors):
            effect, half = 2 * slopes[index + 1], 2 * reach[index + 1]
            rows.append(
                {
                    "output": output,
                    "factor": factor.name,
                    "effect": float(effect),
                    "lower": float(effect - half),
                    "upper": float(effect + half),
                    "share": float(explained[index] / total) if moved else 0.0,
                }
            )
    return pd.DataFrame(rows, columns=["output", "factor", "effect", "lower", "upper", "share"])
