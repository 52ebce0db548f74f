"""Polygons in the plane: whether the sides of one cross.

Written out because geometry libraries (shapely) are a large dependency for one question asked of a handful of
corners.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

Corner = tuple[float, float]


def crossing(corners: Sequence[Corner]) -> tuple[int, int] | None:
    """Find two sides of a closed polygon that meet elsewhere than in a shared corner.

    Parameters
    ----------
    corners : sequence of (x, y)
        In turn; the last side leads back to the first corner. A repeated first corner at the end is allowed.

    Returns
    -------
    tuple of int, optional
        Indices of the sides' first corners, or None when the polygon is simple.
    """
    if len(corners) > 1 and corners[0] == corners[-1]:
        corners = corners[:-1]
    count = len(corners)
    sides = [(corners[i], corners[(i + 1) % count]) for i in range(count)]
    order = sorted(range(count), key=lambda i: min(sides[i][0][0], sides[i][1][0]))
    for position, i in enumerate(order):
        right = max(sides[i][0][0], sides[i][1][0])
        for j in order[position + 1 :]:
            if min(sides[j][0][0], sides[j][1][0]) > right:
                break  # sorted from left to right: no further side can reach this one
            adjacent = (i - j) % count in {1, count - 1}
            if _folded(sides[i], sides[j]) if adjacent else _meet(sides[i], sides[j]):
                return (min(i, j), max(i, j))
    return None


def _turn(a: Corner, b: Corner, c: Corner) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _within(a: Corner, b: Corner, c: Corner) -> bool:
    """Tell whether `c`, on the line through `a` and `b`, lies between them."""
    return min(a[0], b[0]) <= c[0] <= max(a[0], b[0]) and min(a[1], b[1]) <= c[1] <= max(a[1], b[1])


def _meet(first: tuple[Corner, Corner], second: tuple[Corner, Corner]) -> bool:
    (a, b), (c, d) = first, second
    sides = (_turn(a, b, c), _turn(a, b, d), _turn(c, d, a), _turn(c, d, b))
    if sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
        return True
    points = ((a, b, c), (a, b, d), (c, d, a), (c, d, b))
    return any(turn == 0 and _within(*three) for turn, three in zip(sides, points, strict=True))


def _folded(first: tuple[Corner, Corner], second: tuple[Corner, Corner]) -> bool:
    """Tell whether two neighbours lie on top of each other beyond their shared corner."""
    shared = first[1] if first[1] in second else first[0]
    a = first[0] if shared == first[1] else first[1]
    b = second[0] if shared == second[1] else second[1]
    along = (a[0] - shared[0]) * (b[0] - shared[0]) + (a[1] - shared[1]) * (b[1] - shared[1])
    return _turn(a, shared, b) == 0 and along > 0
