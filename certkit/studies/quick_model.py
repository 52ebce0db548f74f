"""The quick model: a plane or parabola through the runs, with its error on runs it has not seen."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Literal

import numpy as np

from certkit.documents.study_report import QuickModel
from certkit.studies.effects import coded

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd
    from numpy.typing import NDArray

    from certkit.studies.factors import Factor

PolynomialKind = Literal["linear", "quadratic"]
KINDS: tuple[PolynomialKind, ...] = ("linear", "quadratic")


def quick_models(table: pd.DataFrame, factors: Sequence[Factor], outputs: Sequence[str]) -> list[QuickModel]:
    """Fit both kinds to every output for which there are enough runs (half as many again as terms)."""
    models = []
    for output in outputs:
        known = table[table[output].notna()]
        if known.empty:
            continue
        y = known[output].to_numpy(dtype=np.float64)
        settings = coded(known, factors)
        for kind in KINDS:
            terms, x = _terms(settings, [factor.name for factor in factors], kind)
            if len(y) >= 1.5 * len(terms):
                models.append(_fit(output, kind, terms, x, y))
    return models


def _terms(
    settings: NDArray[np.float64], names: list[str], kind: PolynomialKind
) -> tuple[list[str], NDArray[np.float64]]:
    terms, columns = ["1", *names], [np.ones(len(settings)), *settings.T]
    if kind == "quadratic":
        for i, j in combinations(range(len(names)), 2):
            terms.append(f"{names[i]} · {names[j]}")
            columns.append(settings[:, i] * settings[:, j])
        for i, name in enumerate(names):
            if np.unique(settings[:, i]).size > 2:
                terms.append(f"{name}²")
                columns.append(settings[:, i] ** 2)
    return terms, np.stack(columns, axis=1)


def _fit(
    output: str,
    kind: PolynomialKind,
    terms: list[str],
    x: NDArray[np.float64],
    y: NDArray[np.float64],
) -> QuickModel:
    inverse = np.linalg.pinv(x)
    coefficients = inverse @ y
    # Leaving one run out needs no second fit: its error is the residual over 1 − leverage (PRESS).
    leverage = np.clip(np.einsum("ij,ji->i", x, inverse), 0, 1 - 1e-9)
    left_out = (y - x @ coefficients) / (1 - leverage)
    total = float(np.mean((y - y.mean()) ** 2))
    error = float(np.mean(left_out**2))
    explained = 1 - error / total if total > 0 else 1.0
    return QuickModel(
        output=output,
        kind=kind,
        terms=terms,
        coefficients=[float(c) for c in coefficients],
        error=float(np.sqrt(error)),
        explained=explained,
    )
