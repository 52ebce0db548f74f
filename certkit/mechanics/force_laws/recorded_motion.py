"""Bodies that are led along a motion recorded elsewhere, whatever presses on them.

With it a leg and a front move as they did in their run, and a contact between them can be judged alone. Its
load takes the place of all others, so it is the last of the laws: that which brings the body in the next step
from where it is to the place recorded,

    F = m·((X(t + Δt) - x)/Δt - v)/Δt'

with the velocity v and the length Δt' of the step that led there; the same along z and for the angle.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.piecewise_linear import held

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows


class RecordedMotion(ForceLaw, kw_only=True, eq=False):
    """A body that is led.

    Parameters
    ----------
    body : Body
    start, points : int
        Its record among the curves: x, z (s, m) and angle (s, rad), each of so many points.
    mass, inertia : float
        Of the body, kg and kg·m².
    """

    body: Body
    start: int
    points: int
    mass: float
    inertia: float

    @staticmethod
    @compiled
    def forces(
        rows: Rows[RecordedMotion],
        now: Instant,
        load: Rows[Load],
        totals: Totals,  # noqa: ARG004  # as all laws have it; what leads a body presses on nothing
    ) -> None:
        """Replace the loads of all bodies that are led."""
        step = 2.0 * now.step if now.time == 0.0 else now.step  # the first step is half as long
        for i in range(len(rows)):
            row = rows[i]
            pose, velocity, on_body = now.pose[row.body], now.step_velocity[row.body], load[row.body]
            x = held(now.curves, row.start, row.points, now.time + step)
            z = held(now.curves, row.start + row.points, row.points, now.time + step)
            angle = held(now.curves, row.start + 2 * row.points, row.points, now.time + step)
            on_body.x = row.mass * ((x - pose.x) / step - velocity.x) / now.step
            on_body.z = row.mass * ((z - pose.z) / step - velocity.z) / now.step
            on_body.torque = row.inertia * ((angle - pose.angle) / step - velocity.angular) / now.step
