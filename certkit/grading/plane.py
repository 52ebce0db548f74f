"""Distances of a curve to the border of its corridor, positive inside and negative outside."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

BETWEEN = 8
"""Points looked at on each straight piece between two samples, so that a corner cannot hide there."""
ON_THE_LINE = 1e-9
"""Share of the corridor's size within which a point lies on its border; a border belongs to the corridor."""


def refined(
    x: NDArray[np.float64], y: NDArray[np.float64], most: int = 4000
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Put points between the samples of a curve, up to about `most` in all.

    Returns
    -------
    x, y : ndarray, shape (m,)
    index : ndarray, shape (m,)
        Fractional sample index of each point.
    """
    pieces = max(1, min(BETWEEN, most // max(1, x.size)))
    samples = np.arange(x.size, dtype=np.float64)
    index = np.linspace(0.0, x.size - 1.0, (x.size - 1) * pieces + 1)
    return (
        np.asarray(np.interp(index, samples, x), dtype=np.float64),
        np.asarray(np.interp(index, samples, y), dtype=np.float64),
        index,
    )


def polygon_distance(
    x: NDArray[np.float64], y: NDArray[np.float64], corners: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how far each point lies inside a polygon.

    The two axes have different units, so distances are taken in the plane scaled to the polygon's own width
    and height, and given in units of the ordinate.

    Parameters
    ----------
    x, y : ndarray, shape (m,)
    corners : ndarray, shape (k, 2)
        In turn; the last is joined to the first.

    Returns
    -------
    ndarray, shape (m,)
        Distance to the nearest side, negative outside, 0 on the border.
    """
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    px, py = (x - low[0]) / size[0], (y - low[1]) / size[1]
    scaled = (corners - low) / size
    nearest = np.full(px.shape, np.inf)
    inside = np.zeros(px.shape, dtype=bool)
    for (ax, ay), (bx, by) in zip(scaled, np.roll(scaled, -1, axis=0), strict=True):
        dx, dy = bx - ax, by - ay
        square = dx * dx + dy * dy
        along = (
            np.clip(((px - ax) * dx + (py - ay) * dy) / square, 0.0, 1.0) if square > 0 else np.zeros_like(px)
        )
        np.minimum(nearest, np.hypot(px - ax - along * dx, py - ay - along * dy), out=nearest)
        # A ray to the right of the point crosses the side: an odd number of crossings is inside.
        across = (ay > py) != (by > py)
        if across.any():
            inside[across] ^= px[across] < ax + (py[across] - ay) / dy * dx
    nearest[nearest <= ON_THE_LINE] = 0.0
    signed: NDArray[np.float64] = np.where(inside, nearest, -nearest) * size[1]
    return signed


def band_distance(
    time: NDArray[np.float64],
    values: NDArray[np.float64],
    lower: NDArray[np.float64] | None,
    upper: NDArray[np.float64] | None,
) -> NDArray[np.float64]:
    """Return how far each sample lies inside a corridor over time; infinite where it does not reach.

    Parameters
    ----------
    time, values : ndarray, shape (m,)
    lower, upper : ndarray, shape (k, 2), or None
        Polylines of (time, value).
    """
    distance = np.full(values.shape, np.inf)
    for line, sign in ((lower, 1.0), (upper, -1.0)):
        if line is not None:
            covered = (time >= line[0, 0]) & (time <= line[-1, 0])
            border = np.interp(time[covered], line[:, 0], line[:, 1])
            distance[covered] = np.minimum(distance[covered], sign * (values[covered] - border))
    return distance
