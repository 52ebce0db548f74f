"""The force of the loading ram: F(t) along -x from a schedule, on the ram's body or straight on the bone.

The schedule is piecewise linear in time. Without a body of its own the force acts on the leg at a station;
on a joint between two segments both take half of it. Its work is counted as negative dissipation, for it
comes from outside.

Source: load levels of the static certification tests, each held until the specimen is at rest.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.leg_outline import piece_at
from certkit.mechanics.force_laws.piecewise_linear import held

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State

JOINT = 1e-9
"""m: how near a joint the station counts as on it."""


class LoadingRamForce(ForceLaw, kw_only=True):
    """One ram.

    Parameters
    ----------
    ram : Body
        Its body; the ground where the force acts straight on the leg.
    station : float
        Height of the force in space, m.
    start : float
        Where the ram (or the loaded point) stands at the beginning, m: travel is counted from here.
    schedule_start, schedule_points : int
        The schedule among the curves: its first point and how many they are.
    force, travel : State
        F (N) and the way of the loaded point along -x (m) now.
    """

    ram: Body
    station: float
    start: float
    schedule_start: int
    schedule_points: int
    force: State = 0.0
    travel: State = 0.0

    @staticmethod
    @compiled
    def forces(rams: Rows[LoadingRamForce], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the ram's force."""
        for i in range(len(rams)):
            ram = rams[i]
            force = held(now.curves, ram.schedule_start, ram.schedule_points, now.time)
            ram.force = force
            if ram.ram < len(now.pose) - 1:
                load[ram.ram].x -= force
                totals.power += force * now.velocity[ram.ram].x
                ram.travel = ram.start - now.pose[ram.ram].x
                continue
            ram.travel = ram.start
            for side in range(2):
                z = ram.station + (JOINT if side == 0 else -JOINT)
                piece = piece_at(now, z, 0)
                if piece < 0:
                    continue
                body = now.outline[piece].body
                pose, velocity = now.pose[body], now.velocity[body]
                lever = ram.station - pose.z
                load[body].x -= 0.5 * force
                load[body].torque += 0.5 * force * lever
                totals.power += 0.5 * force * (velocity.x - velocity.angular * lever)
                ram.travel -= 0.5 * (pose.x - lever * pose.sin / pose.cos)
