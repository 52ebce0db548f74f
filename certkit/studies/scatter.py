"""Scatter of tests: how probable it is that a criterion stays inside, and which one leaves first."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.documents.study_report import Chance

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import NDArray

MARGIN = " margin"
CONFIDENCE = 0.95


def chances(table: pd.DataFrame) -> list[Chance]:
    """Return the chance of every graded criterion, the one that fails first on top, and of all together."""
    columns = [str(name) for name in table if str(name).endswith(MARGIN)]
    if not columns or table.empty:
        return []
    margins = table[columns].to_numpy(dtype=np.float64)
    inside = margins >= 0
    # Margins of moments and elongations are compared by how far each scatters.
    spread = np.array([_sd(column) for column in margins.T])
    known = np.where(np.isnan(margins), np.inf, margins / np.where(spread > 0, spread, 1.0))
    worst = np.where((known < 0).any(axis=1), known.argmin(axis=1), -1)
    unknown = np.isnan(margins)
    rows = [
        _chance(
            name.removesuffix(MARGIN),
            np.asarray(inside[:, i]),
            float(np.nanmean(margins[:, i]) / spread[i]) if spread[i] > 0 else None,
            first=int((worst == i).sum()),
            unknown=int(unknown[:, i].sum()),
        )
        for i, name in enumerate(columns)
    ]
    rows.sort(key=lambda row: (row.probability, np.inf if row.distance is None else row.distance))
    all_inside = inside.all(axis=1)
    doubtful = int((unknown.any(axis=1) & ~(known < 0).any(axis=1)).sum())
    together = _chance(
        "all", np.asarray(all_inside), None, first=int((~all_inside).sum()) - doubtful, unknown=doubtful
    )
    return [*rows, together]


def _sd(column: NDArray[np.float64]) -> float:
    known = column[~np.isnan(column)]
    return float(known.std(ddof=1)) if known.size > 1 else 0.0


def _chance(
    criterion: str, inside: NDArray[np.bool_], distance: float | None, *, first: int, unknown: int
) -> Chance:
    from scipy.stats import binomtest  # noqa: PLC0415  # slow to import

    count, runs = int(inside.sum()), int(inside.size)
    interval = binomtest(count, runs).proportion_ci(CONFIDENCE, method="exact")
    return Chance(
        criterion=criterion,
        inside=count,
        runs=runs,
        probability=count / runs,
        lower=float(interval.low),
        upper=float(interval.high),
        distance=distance,
        first=first,
        unknown=unknown,
    )
