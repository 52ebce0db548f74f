"""Distances of a curve to the border of its corridor, positive inside and negative outside."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

BETWEEN = 8
"""Points looked at on each straight piece between two samples, so that a corner cannot hide there."""
STEEP = 0.5
"""Sine of the angle (30°) at which a curve has to meet a side for it to be the corridor's end."""
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
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    corners: NDArray[np.float64],
    open_sides: frozenset[int] = frozenset(),
) -> NDArray[np.float64]:
    """Return how far each point lies inside a polygon.

    The two axes have different units, so distances are taken in the plane scaled to the polygon's own width
    and height, and given in units of the ordinate.

    Parameters
    ----------
    x, y : ndarray, shape (m,)
    corners : ndarray, shape (k, 2)
        In turn; the last is joined to the first.
    open_sides : frozenset of int
        Sides (by their first corner) that a point inside may come near to without being near the border:
        `end_faces`.

    Returns
    -------
    ndarray, shape (m,)
        Distance to the nearest side, negative outside, 0 on the border.
    """
    px, py, scaled = _scaled(x, y, corners)
    nearest, inner = np.full(px.shape, np.inf), np.full(px.shape, np.inf)
    inside = np.zeros(px.shape, dtype=bool)
    for side, ((ax, ay), (bx, by)) in enumerate(zip(scaled, np.roll(scaled, -1, axis=0), strict=True)):
        dx, dy = bx - ax, by - ay
        square = dx * dx + dy * dy
        along = np.clip(((px - ax) * dx + (py - ay) * dy) / (square or 1.0), 0.0, 1.0)
        distance = np.hypot(px - ax - along * dx, py - ay - along * dy)
        np.minimum(nearest, distance, out=nearest)
        if side not in open_sides:
            np.minimum(inner, distance, out=inner)
        # A ray to the right of the point crosses the side: an odd number of crossings is inside.
        across = (ay > py) != (by > py)
        if across.any():
            inside[across] ^= px[across] < ax + (py[across] - ay) / dy * dx
    inside |= nearest <= ON_THE_LINE
    inner[inner <= ON_THE_LINE] = 0.0
    signed: NDArray[np.float64] = np.where(inside, inner, -nearest) * np.ptp(corners, axis=0)[1]
    return signed


def end_faces(x: NDArray[np.float64], y: NDArray[np.float64], corners: NDArray[np.float64]) -> frozenset[int]:
    """Return the sides through which a curve enters and leaves a polygon, or would if it went on.

    The curve is x and y, shape (n,), the polygon its corners, shape (k, 2), in the same two units; a side has
    the number of its first corner.

    A corridor begins and ends somewhere; a curve that runs through it from end to end is near those sides
    without being near its limits. They are the sides that the curve's two ends point at, at more than 30°
    (scaled), so that a curve that closes in on a limit still counts as near to it.
    """
    px, py, scaled = _scaled(x, y, corners)
    reach = max(1, px.size // 20)
    ends = (
        (px[0], py[0], px[0] - px[reach], py[0] - py[reach]),
        (px[-1], py[-1], px[-1] - px[-1 - reach], py[-1] - py[-1 - reach]),
    )
    faces = {_side_ahead(scaled, *(float(v) for v in end)) for end in ends} - {None}
    return frozenset(side for side in faces if side is not None and len(faces) < len(corners) - 1)


def _side_ahead(corners: NDArray[np.float64], x: float, y: float, dx: float, dy: float) -> int | None:
    """Return the nearest side that a ray meets; None where there is none or it is met at less than 30°."""
    length = math.hypot(dx, dy)
    found, nearest = None, math.inf
    for side, ((ax, ay), (bx, by)) in enumerate(zip(corners, np.roll(corners, -1, axis=0), strict=True)):
        sx, sy = bx - ax, by - ay
        turn = dx * sy - dy * sx
        if length == 0 or abs(turn) < 1e-12:
            continue
        ahead = ((ax - x) * sy - (ay - y) * sx) / turn * length
        along = ((ax - x) * dy - (ay - y) * dx) / turn
        if ahead > -1e-6 and -1e-9 <= along <= 1 + 1e-9 and ahead < nearest:
            steep = abs(turn) > STEEP * length * math.hypot(sx, sy)
            found, nearest = side if steep else None, ahead
    return found


def _scaled(
    x: NDArray[np.float64], y: NDArray[np.float64], corners: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Scale points and corners to the polygon's width and height."""
    low, size = corners.min(axis=0), np.ptp(corners, axis=0)
    return (x - low[0]) / size[0], (y - low[1]) / size[1], (corners - low) / size


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
