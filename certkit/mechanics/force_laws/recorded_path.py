"""Quantities tabulated along a recorded path: over a progress on the way in, over its share on the way back.

On the way in a quantity is y(ξ), over the largest progress ξₘ so far (m). On the way back, at the share
s = ξ/ξₘ, what the recorded run added is added, in the measure of how far in it begins:
y(ξₘ) + Δy(s)·min(ξₘ/ξ_end, 1), with Δy(1) = 0 and the path's end ξ_end. So a trembling before the way in has
begun is no way back. Beyond the tables' ends the last value holds. Several quantities of one path are curves
of equally many points that follow each other.

Where a quantity has to end as in the recorded run, as a contact force that ends when the contact does, a way
back that begins before the path's end joins the recorded one, over the first fifth of its share
(`on_joining_path`): (y(ξ_end) + Δy(s))·w + b(s)·(y(ξₘ) - w·y(ξ_end)), with w = min(ξₘ/ξ_end, 1) and b from 1
at s = 1 to 0 at s = 0.8. On the recorded path both are the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.piecewise_linear import held

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import CurvePoint
    from certkit.mechanics.records import Rows


class RecordedPath(Protocol):
    """A row that says where its path's tables stand among the curves: first point and number, each way."""

    in_start: int
    in_points: int
    back_start: int
    back_points: int


@compiled
def _on_way_in(
    curves: Rows[CurvePoint], path: RecordedPath, quantity: int, largest: float
) -> tuple[float, float, float]:
    """Return a quantity at the largest progress, its last value, and w."""
    first = path.in_start + quantity * path.in_points
    last = first + path.in_points - 1
    end = curves[last].x
    weight = min(largest / end, 1.0) if end > 0.0 else 1.0
    return held(curves, first, path.in_points, largest), curves[last].force, weight


@compiled
def _added(curves: Rows[CurvePoint], path: RecordedPath, quantity: int, share: float) -> float:
    """Return what a quantity gains on the way back."""
    return held(curves, path.back_start + quantity * path.back_points, path.back_points, share)


@compiled
def on_path(
    curves: Rows[CurvePoint], path: RecordedPath, quantity: int, progress: float, largest: float
) -> float:
    """Return a quantity of a path by its number."""
    value, _, weight = _on_way_in(curves, path, quantity, largest)
    if path.back_points > 0 and largest > 0.0:
        value += weight * _added(curves, path, quantity, progress / largest)
    return value


JOINED = 0.8
"""Share of the largest progress at which a way back has joined the recorded one."""


@compiled
def on_joining_path(
    curves: Rows[CurvePoint], path: RecordedPath, quantity: int, progress: float, largest: float
) -> float:
    """Return a quantity of a path by its number; its way back joins the recorded one."""
    value, last, weight = _on_way_in(curves, path, quantity, largest)
    if path.back_points > 0 and largest > 0.0 and progress < largest:
        share = progress / largest
        left = max((share - JOINED) / (1.0 - JOINED), 0.0)
        value = (last + _added(curves, path, quantity, share)) * weight + left * (value - weight * last)
    return value
