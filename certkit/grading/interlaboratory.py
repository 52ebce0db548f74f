"""Precision of a test over several laboratories: repeatability, reproducibility, outliers, scores.

By ISO 5725-2:2019 (repeatability and reproducibility, Mandel's h and k, Cochran's and Grubbs' tests) and ISO
13528:2022 (robust mean, z-scores). No kept Python package offers them: scipy has the distributions that the
critical values come from, and those are used. Unequal numbers of tests are allowed everywhere.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.typing import NDArray

STRAGGLER, OUTLIER = 0.05, 0.01
"""Levels of significance of ISO 5725-2, 8.3.1: beyond the first a straggler, beyond the second an outlier."""

FEWEST_LABORATORIES = 3
"""Below, no mean can be told from the others, so that neither Grubbs' test nor Mandel's h is given."""

SAME = 1e-7
"""Share of their size by which values may differ and be one: documents keep seven digits, and what is left of
equal ones in the last bits is no scatter."""

_ROBUST_STEPS = 200
_ROBUST_ENDS = 1e-9


class Precision(Struct, frozen=True):
    """Standard deviations of one criterion, in its unit.

    Parameters
    ----------
    mean : float
        Over all tests, each with the same weight.
    within : float or None
        Repeatability s_r, one laboratory, one leg: the pooled standard deviation within laboratories. None
        where no laboratory tested twice.
    between : float or None
        s_L of the laboratories' own share; zero where the means differ by less than s_r explains.
    total : float or None
        Reproducibility s_R = √(s_r² + s_L²). Where no laboratory tested twice, the standard deviation of the
        single values, which holds both shares.
    """

    mean: float
    within: float | None
    between: float | None
    total: float | None


class LaboratoryStatistics(Struct, frozen=True):
    """One laboratory among the others.

    Parameters
    ----------
    mean, deviation : float, float or None
        Of its tests; the deviation needs two.
    z : float or None
        Distance of its mean from the robust mean of all, in robust standard deviations (ISO 13528, 9.4).
    h, k : float or None
        Mandel's: its mean among the means, and s_i·√p / √Σs², its scatter among those of p laboratories
        (ISO 5725-2:1994, 7.3.1.3).
    found : tuple of (str, str)
        Tests that it fell in, and as what: `("cochran", "outlier")`, `("grubbs", "straggler")`.
    """

    mean: float
    deviation: float | None
    z: float | None
    h: float | None
    k: float | None
    found: tuple[tuple[str, str], ...] = ()


def precision(tests: Mapping[str, Sequence[float]]) -> Precision:
    """Return repeatability and reproducibility (ISO 5725-2, 8.4).

    With p laboratories of n_i tests each, N in all, means m_i and variances s_i²:
    s_r² = Σ(n_i − 1)s_i² / (N − p), s_d² = Σ n_i(m_i − m)² / (p − 1), n̄ = (N − Σn_i²/N) / (p − 1) and
    s_L² = max(0, (s_d² − s_r²) / n̄).

    Parameters
    ----------
    tests : mapping of str to sequence of float
        Values by laboratory, at least one each.
    """
    rows = [np.asarray(values, dtype=float) for values in tests.values()]
    counts = np.array([row.size for row in rows], dtype=float)
    means = np.array([row.mean() for row in rows])
    number, size = len(rows), float(counts.sum())
    mean = float(counts @ means / size)
    within = None
    if size > number:
        within = math.sqrt(sum(_squares(row) for row in rows) / (size - number))
    if number < 2:  # one laboratory alone
        return Precision(mean, within, None, None)
    spread = float(counts @ (means - mean) ** 2) / (number - 1)
    if within is None:
        return Precision(mean, None, None, math.sqrt(spread))
    usual = (size - float(counts @ counts) / size) / (number - 1)
    between = math.sqrt(max(0.0, (spread - within**2) / usual))
    return Precision(mean, within, between, math.hypot(within, between))


def robust_mean(values: Sequence[float]) -> tuple[float, float]:
    """Return robust mean and standard deviation by algorithm A (ISO 13528:2022, C.3).

    Values beyond 1.5 standard deviations are drawn in to there, and both are taken again until they stand.
    """
    given = np.asarray(values, dtype=float)
    mean = float(np.median(given))
    deviation = 1.483 * float(np.median(np.abs(given - mean)))
    for _ in range(_ROBUST_STEPS):
        reach = 1.5 * deviation
        drawn = np.clip(given, mean - reach, mean + reach)
        new = float(drawn.mean())
        wider = 1.134 * float(drawn.std(ddof=1)) if given.size > 1 else 0.0
        still = abs(new - mean) + abs(wider - deviation) <= _ROBUST_ENDS * (abs(mean) + deviation)
        mean, deviation = new, wider
        if still:
            break
    return mean, deviation


def statistics_by_laboratory(tests: Mapping[str, Sequence[float]]) -> dict[str, LaboratoryStatistics]:
    """Return what each laboratory's values are among all of them.

    Parameters
    ----------
    tests : mapping of str to sequence of float
        Values by laboratory, at least one each.
    """
    names = list(tests)
    rows = {name: np.asarray(tests[name], dtype=float) for name in names}
    means = np.array([rows[name].mean() for name in names])
    centre, scale = robust_mean(means.tolist())
    scatter = [_deviation(row) ** 2 for row in rows.values() if row.size > 1]
    usual = math.sqrt(sum(scatter) / len(scatter)) if scatter else 0.0
    spread = _deviation(means) if len(names) >= FEWEST_LABORATORIES else 0.0
    marks = (_cochran(rows), _grubbs(means, names))
    return {
        name: LaboratoryStatistics(
            mean=float(mean),
            deviation=_deviation(rows[name]) if rows[name].size > 1 else None,
            z=(float(mean) - centre) / scale if scale > 0 else None,
            h=(float(mean) - float(means.mean())) / spread if spread > 0 else None,
            k=_deviation(rows[name]) / usual if usual > 0 and rows[name].size > 1 else None,
            found=tuple(mark[name] for mark in marks if name in mark),
        )
        for name, mean in zip(names, means, strict=True)
    }


def cochran_critical(level: float, laboratories: int, own: int, others: int) -> float:
    """Return the largest share that one laboratory may have in the squares of all (ISO 5725-2, 8.3.4).

    C = 1 / (1 + ν_o / (ν·F)), F the quantile at 1 − level/p with ν degrees of freedom of its own and ν_o of
    the others. With n tests everywhere, ν = n − 1, that is Cochran's; with unequal numbers each laboratory
    has a bound of its own, and the level is kept (R. U. E. 't Lam, Anal. Chim. Acta 659 (2010) 68).
    """
    from scipy.special import fdtri  # noqa: PLC0415  # scipy is slow to import, and for these tests only

    quantile = float(fdtri(own, others, 1 - level / laboratories))
    return 1 / (1 + others / (own * quantile))


def grubbs_critical(level: float, laboratories: int) -> float:
    """Return the largest distance of one mean from p means, in their standard deviation (ISO 5725-2, 8.3.5).

    G = (p − 1) / √p · √(t² / (p − 2 + t²)), t the quantile at 1 − level/(2p) with p − 2 degrees of freedom.
    """
    from scipy.stats import t  # noqa: PLC0415  # likewise

    square = float(t.ppf(1 - level / (2 * laboratories), laboratories - 2)) ** 2
    return (laboratories - 1) / math.sqrt(laboratories) * math.sqrt(square / (laboratories - 2 + square))


def _squares(row: NDArray[np.float64]) -> float:
    """Return the sum of squared distances from the mean; none where the values are one but for rounding."""
    if np.ptp(row) <= SAME * float(np.abs(row).max()):
        return 0.0
    return float(((row - row.mean()) ** 2).sum())


def _deviation(row: NDArray[np.float64]) -> float:
    return math.sqrt(_squares(row) / (row.size - 1))


def _cochran(rows: Mapping[str, NDArray[np.float64]]) -> dict[str, tuple[str, str]]:
    """Test the scatter that is least like the others' by chance, among all that tested twice."""
    from scipy.special import fdtrc  # noqa: PLC0415  # likewise

    twice = {name: row for name, row in rows.items() if row.size > 1}
    squares = {name: _squares(row) for name, row in twice.items()}
    total, freedom = sum(squares.values()), sum(row.size - 1 for row in twice.values())
    if len(twice) < 2 or total == 0:
        return {}

    def chance(name: str) -> tuple[float, float]:
        own, rest = twice[name].size - 1, total - squares[name]
        ratio = squares[name] / own * (freedom - own) / rest if rest > 0 else math.inf
        return float(fdtrc(own, freedom - own, ratio)), -squares[name]

    odd = min(twice, key=chance)
    own = twice[odd].size - 1
    mark = _judged(
        squares[odd] / total, lambda level: cochran_critical(level, len(twice), own, freedom - own)
    )
    return {odd: ("cochran", mark)} if mark else {}


def _grubbs(means: NDArray[np.float64], names: Sequence[str]) -> dict[str, tuple[str, str]]:
    """Test the mean that lies farthest from all."""
    spread = _deviation(means) if len(names) >= FEWEST_LABORATORIES else 0.0
    if spread == 0:
        return {}
    away = np.abs(means - means.mean()) / spread
    mark = _judged(float(away.max()), lambda level: grubbs_critical(level, len(names)))
    return {names[int(away.argmax())]: ("grubbs", mark)} if mark else {}


def _judged(value: float, critical: Callable[[float], float]) -> str:
    if value > critical(OUTLIER):
        return "outlier"
    return "straggler" if value > critical(STRAGGLER) else ""
