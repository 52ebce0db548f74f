"""Shares of probability: points from numbers between 0 and 1, and how such numbers are made to correlate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from certkit.studies.factors import Factor
    from certkit.studies.points import Point


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
    """Build the matrix of correlation coefficients, shape (k, k); None when nothing is correlated.

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
        raise UsageError(
            "the correlations contradict each other: no factors can vary together like this"
            "; lower the largest of them"
        )
    return matrix


def correlated(shares: NDArray[np.float64], matrix: NDArray[np.float64] | None) -> NDArray[np.float64]:
    """Reorder each column so that the ranks correlate by a matrix.

    `shares` have the shape (runs, k), the matrix has (k, k). Source: Iman and Conover 1982.
    """
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
