"""Piecewise-linear curves that laws refer to: force over shortening, force over time, a recorded path."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import CurvePoint
    from certkit.mechanics.records import Rows


@compiled
def held(curves: Rows[CurvePoint], start: int, count: int, x: float) -> float:
    """Return a curve's value at x, linear between its points and held beyond its ends.

    Parameters
    ----------
    curves : shape (k,)
        Points of all curves.
    start, count : int
        First point of this one, and how many it has; their x rise.
    x : float
    """
    low, high = start, start + count - 1
    if x >= curves[high].x:
        return curves[high].force
    if x <= curves[low].x:
        return curves[low].force
    while high - low > 1:
        middle = (low + high) // 2
        if x < curves[middle].x:
            high = middle
        else:
            low = middle
    share = (x - curves[low].x) / (curves[high].x - curves[low].x)
    return curves[low].force + share * (curves[high].force - curves[low].force)
