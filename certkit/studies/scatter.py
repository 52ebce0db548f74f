"""Scatter of tests: how probable it is that a criterion stays inside, and which one leaves first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import NDArray

MARGIN = " margin"
CONFIDENCE = 0.95


@dataclass(frozen=True)
class Chance:
    """How often a criterion stayed inside.

    Parameters
    ----------
    criterion : str
        `PROCEDURE/CRITERION`, or `all` for every graded criterion at once.
    inside, runs : int
        A run without the value counts as outside: missing never passes.
    probability, lower, upper : float
        Share inside with its 95 % interval after Clopper and Pearson, which never promises too much.
    distance : float
        Mean margin in standard deviations of the margin; the smallest fails first. NaN for `all` or no
        scatter.
    first : int
        Runs in which this criterion is the one farthest outside.
    """

    criterion: str
    inside: int
    runs: int
    probability: float
    lower: float
    upper: float
    distance: float
    first: int


def chances(table: pd.DataFrame) -> list[Chance]:
    """Return the chance of every graded criterion, the one that fails first on top, and of all together."""
    columns = [str(name) for name in table if str(name).endswith(MARGIN)]
    if not columns or table.empty:
        return []
    margins = table[columns].to_numpy(dtype=np.float64)
    inside = margins >= 0
    # Margins of moments and elongations are compared by how far each scatters.
    spread = np.array([_sd(column) for column in margins.T])
    scaled = np.where(np.isnan(margins), -np.inf, margins / np.where(spread > 0, spread, 1.0))
    failing = ~inside.all(axis=1)
    worst = scaled[failing].argmin(axis=1)
    rows = [
        _chance(
            name.removesuffix(MARGIN),
            np.asarray(inside[:, i]),
            float(np.nanmean(margins[:, i]) / spread[i]) if spread[i] > 0 else float("nan"),
            int((worst == i).sum()),
        )
        for i, name in enumerate(columns)
    ]
    rows.sort(key=lambda row: (row.probability, np.inf if np.isnan(row.distance) else row.distance))
    return [*rows, _chance("all", np.asarray(inside.all(axis=1)), float("nan"), int(failing.sum()))]


def _sd(column: NDArray[np.float64]) -> float:
    known = column[~np.isnan(column)]
    return float(known.std(ddof=1)) if known.size > 1 else 0.0


def _chance(criterion: str, inside: NDArray[np.bool_], distance: float, first: int) -> Chance:
    from scipy.stats import binomtest  # noqa: PLC0415  # slow to import

    count, runs = int(inside.sum()), int(inside.size)
    interval = binomtest(count, runs).proportion_ci(CONFIDENCE, method="exact")
    return Chance(
        criterion, count, runs, count / runs, float(interval.low), float(interval.high), distance, first
    )
