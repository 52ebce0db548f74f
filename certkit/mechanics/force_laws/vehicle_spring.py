"""A spring between two groups of a vehicle, or a group and the ground, along x.

Loading follows a piecewise-linear curve F(x) over the shortening x (m). Unloading and reloading follow a
branch of their own, max(F(x_m) - k_u·(x_m - x), r·F(x_m)·(x - x_r)/(x_m - x_r), 0), never above the curve's
largest force up to x, with the largest shortening x_m so far, unloading stiffness k_u (N/m), residual share r
and permanent set x_r = s·x_m. A pulling side, where there is one, is the same law with a memory of its own. A
damper c·ẋ (N·s/m) acts beside it, which without a pulling side never turns the spring into one that pulls.

Source: the same law as `certkit.identification.spring_law`, which fits it to finite-element histories; a
test holds the two together.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import CurvePoint, ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


@compiled
def _loading(curves: Rows[CurvePoint], start: int, count: int, x: float) -> float:
    """Return the force at x ≥ 0, continued with the last slope, but never with a falling one."""
    low, high = start, start + count - 1  # its own search: with the shared one fronts take 4 % longer
    if x >= curves[high].x:
        slope = (curves[high].force - curves[high - 1].force) / (curves[high].x - curves[high - 1].x)
        return curves[high].force + max(slope, 0.0) * (x - curves[high].x)
    while high - low > 1:
        middle = (low + high) // 2
        if x < curves[middle].x:
            high = middle
        else:
            low = middle
    share = (x - curves[low].x) / (curves[high].x - curves[low].x)
    return curves[low].force + share * (curves[high].force - curves[low].force)


@compiled
def _highest(curves: Rows[CurvePoint], start: int, count: int, x: float) -> float:
    """Return the largest force of the loading curve up to x."""
    highest = _loading(curves, start, count, x)
    for k in range(start, start + count):
        if curves[k].x >= x:
            break
        highest = max(highest, curves[k].force)
    return highest


@compiled
def _work(curves: Rows[CurvePoint], start: int, count: int, x: float) -> float:
    """Return the area under the loading curve up to x ≥ 0: the most that a spring can have stored."""
    area = 0.0
    for k in range(start, start + count):
        last = k == start + count - 1
        low = curves[k].x
        if low >= x:
            break
        high = x if last else min(curves[k + 1].x, x)
        area += (
            0.5 * (_loading(curves, start, count, low) + _loading(curves, start, count, high)) * (high - low)
        )
    return area


@compiled
def _side(
    curves: Rows[CurvePoint], start: int, count: int, x: float, top: float, row: VehicleSpring
) -> tuple[float, float]:
    """Return force and recoverable energy of one side at x ≥ 0, whose largest value so far is `top`."""
    unloading, residual, rest = row.unloading, row.residual, row.permanent_set * top
    peak = _loading(curves, start, count, top)
    steep = max(peak - unloading * (top - x), 0.0)
    flat = residual * peak / (top - rest) if top > rest else 0.0
    soft = flat * max(x - rest, 0.0)
    force = peak if x >= top else min(max(steep, soft), _highest(curves, start, count, x))
    # Area under the branch: the flat part from the permanent set, and what the steep part stands above it.
    stored = 0.5 * soft * max(x - rest, 0.0)
    above = steep - soft
    if above > 0.0 and unloading > flat:
        foot = x - above / (unloading - flat)
        if foot < rest:  # the steep part meets zero before the flat one begins
            stored = 0.5 * steep * steep / unloading
        else:
            stored = 0.5 * flat * (foot - rest) * (foot - rest) + 0.5 * (steep + flat * (foot - rest)) * (
                x - foot
            )
    if unloading * x < steep:  # softer than it was loaded, the branch is cut off by the loading curve
        stored = min(stored, _work(curves, start, count, x))
    return force, stored


class VehicleSpring(ForceLaw, kw_only=True):
    """One connection of the vehicle.

    Parameters
    ----------
    first, second : Body
        It is shortened where the first comes nearer to the second, along +x.
    rest : float
        Distance of the two along x where the spring is neither shortened nor lengthened, m.
    push_start, push_points, pull_start, pull_points : int
        Its loading curves among the curves: first point, and how many; no pulling side with 0 points.
    unloading : float
        k_u, N/m.
    residual, permanent_set : float
        r and s.
    damping : float
        c, N·s/m.
    longest_push, longest_pull : State
        x_m of each side, m: remembered from step to step.
    shortening, force : State
        x (m) and force with damper (N) now.
    spring_force, stored : State
        Force without damper (N) and recoverable energy (J) now, for the energy lost in the next step.
    """

    first: Body
    second: Body
    rest: float
    push_start: int
    push_points: int
    pull_start: int
    pull_points: int
    unloading: float
    residual: float
    permanent_set: float
    damping: float
    longest_push: State = 0.0
    longest_pull: State = 0.0
    shortening: State = 0.0
    force: State = 0.0
    spring_force: State = 0.0
    stored: State = 0.0

    @staticmethod
    @compiled
    def forces(springs: Rows[VehicleSpring], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the springs' and dampers' forces."""
        curves = now.curves
        for i in range(len(springs)):
            row = springs[i]
            first, second = row.first, row.second
            x = now.pose[first].x - now.pose[second].x - row.rest
            v = now.velocity[first].x - now.velocity[second].x
            start, count = row.push_start, row.push_points
            pushed = max(x, 0.0)
            top = max(row.longest_push, pushed)
            spring, stored = _side(curves, start, count, pushed, top, row)
            pulls = row.pull_points > 0
            longest = row.longest_pull
            if pulls:
                # The pulling side starts from the length that the shortening has left behind.
                if row.residual > 0.0:
                    length = row.permanent_set * top
                else:
                    length = max(top - _loading(curves, start, count, top) / row.unloading, 0.0)
                y = length - x
                if y > 0.0:
                    longest = max(longest, y)
                    pull, energy = _side(curves, row.pull_start, row.pull_points, y, longest, row)
                    spring, stored = -pull, stored + energy
            damper = row.damping * v
            if not pulls:
                damper = max(damper, -spring) if spring > 0.0 else 0.0
            work = 0.5 * (spring + row.spring_force) * (x - row.shortening)
            totals.dissipated += work - (stored - row.stored)
            totals.stored += stored
            totals.power += damper * v
            force = spring + damper
            load[first].x -= force
            load[second].x += force
            row.longest_push = top
            row.longest_pull = longest
            row.shortening = x
            row.force = force
            row.spring_force = spring
            row.stored = stored
