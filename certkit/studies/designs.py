"""Designs: where in the space of its factors a study puts its runs. Same seed, same points."""

from __future__ import annotations

from itertools import product
from math import prod
from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import UsageError
from certkit.files.limits import MAX_RUNS, MAX_SETTINGS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from certkit.studies.factors import Factor
    from certkit.studies.points import Point


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


def check_runs(runs: int, factors: int, wanted: str) -> None:
    """Refuse too many runs, before a single point is made.

    Parameters
    ----------
    runs, factors : int
    wanted : str
        What asks for them.

    Raises
    ------
    UsageError
        Above `MAX_RUNS`, or `MAX_SETTINGS` for all runs together.
    """
    most = min(MAX_RUNS, MAX_SETTINGS // max(1, factors))
    if runs > most:
        raise UsageError(
            f"a {wanted} of {factors} parameters has {runs:,} runs; more than {most:,} are refused: take a "
            "smaller one, or split it (the bounds are MAX_RUNS and MAX_SETTINGS in certkit/files/limits.py)"
        )


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


def latin_hypercube(
    factors: Sequence[Factor], runs: int, seed: int, correlation: NDArray[np.float64] | None = None
) -> list[Point]:
    """Spread the runs so that each factor has one in every slice of equal probability.

    Parameters
    ----------
    factors : sequence of Factor
    runs, seed : int
    correlation : ndarray, shape (k, k), optional
        Of the factors' normal scores (a Gaussian copula); slices stay, their combination changes.
    """
    from scipy.stats import qmc  # noqa: PLC0415  # scipy is slow to import

    check_runs(runs, len(factors), "latin hypercube")
    shares = qmc.LatinHypercube(len(factors), rng=np.random.default_rng(seed)).random(runs)
    return at_shares(factors, _correlated(shares, correlation))


def sobol_sequence(
    factors: Sequence[Factor], runs: int, seed: int, correlation: NDArray[np.float64] | None = None
) -> list[Point]:
    """Fill the space evenly with a scrambled Sobol sequence, rounded up to a power of two."""
    from scipy.stats import qmc  # noqa: PLC0415  # scipy is slow to import

    power = (runs - 1).bit_length()
    check_runs(1 << power, len(factors), "sobol sequence")
    sequence = qmc.Sobol(len(factors), rng=np.random.default_rng(seed))
    return at_shares(factors, _correlated(sequence.random_base2(power), correlation))


def at_shares(factors: Sequence[Factor], shares: NDArray[np.float64]) -> list[Point]:
    """Turn shares of probability, shape (n, k), into points."""
    inside = np.clip(shares, 1e-12, 1 - 1e-12)
    return [
        {factor.name: factor.distribution.quantile(float(p)) for factor, p in zip(factors, row, strict=True)}
        for row in inside
    ]


def correlation_matrix(
    factors: Sequence[Factor], pairs: Sequence[tuple[str, str, float]]
) -> NDArray[np.float64] | None:
    """Build the matrix of correlation coefficients; None when nothing is correlated.

    Raises
    ------
    UsageError
        When the coefficients contradict each other.
    """
    if not pairs:
        return None
    place = {factor.name: index for index, factor in enumerate(factors)}
    matrix = np.eye(len(factors))
    for first, second, coefficient in pairs:
        matrix[place[first], place[second]] = matrix[place[second], place[first]] = coefficient
    if np.linalg.eigvalsh(matrix)[0] <= 1e-9:
        raise UsageError("the correlations contradict each other: no factors can vary together like this")
    return matrix


def _correlated(shares: NDArray[np.float64], matrix: NDArray[np.float64] | None) -> NDArray[np.float64]:
    """Reorder each column so that the ranks correlate (Iman and Conover 1982)."""
    if matrix is None:
        return shares
    from scipy.special import ndtri  # noqa: PLC0415  # scipy is slow to import

    scores = ndtri(np.clip(shares, 1e-12, 1 - 1e-12))
    # Take out the correlation that the sample has by chance, so that small samples are right too.
    own = np.linalg.cholesky(np.corrcoef(scores, rowvar=False))
    wanted = np.linalg.cholesky(matrix)
    mixed = scores @ np.linalg.inv(own).T @ wanted.T
    ranks = mixed.argsort(axis=0).argsort(axis=0)
    return np.take_along_axis(np.sort(shares, axis=0), ranks, axis=0)
