"""A roller under the bone in three-point bending: it stays where it is while the bone slides over it.

Reaction F = max(k·d - c·v, 0) along the load (+x), with the depth d of the roller in the bone at the
roller's own station z (m), contact stiffness k (N/m), damping c (N·s/m) and the speed v at which the bone's
surface moves away there.

The roller stands at x = 0 and a fixed station, so the moment at mid-span is F/2 times half the span
whatever the deflection: what a frictionless roller would add along the bone is taken by friction there, and
the work of that friction is counted as dissipated.

Source: a modelling choice: with supports that travel with the bone the mid-span moment would fall below F/2
times half the span as the bone bends.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.leg_outline import piece_at

if TYPE_CHECKING:
    from certkit.mechanics.records import Rows, State


class SupportRoller(ForceLaw, kw_only=True):
    """One roller.

    Parameters
    ----------
    station : float
        Its height z in space, m.
    stiffness, damping : float
        k (N/m) and c (N·s/m).
    depth, force : State
        d (m) and F (N) now.
    """

    station: float
    stiffness: float
    damping: float = 0.0
    depth: State = 0.0
    force: State = 0.0

    @staticmethod
    @compiled
    def forces(rollers: Rows[SupportRoller], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the rollers' reactions."""
        for i in range(len(rollers)):
            roller = rollers[i]
            z = roller.station
            roller.depth = 0.0
            roller.force = 0.0
            piece = piece_at(now, z, 0)
            if piece < 0:
                continue
            body = now.outline[piece].body
            pose, velocity = now.pose[body], now.velocity[body]
            tangent = pose.sin / pose.cos
            lever = z - pose.z
            depth = lever * tangent - pose.x
            if depth <= 0.0:
                continue
            point_speed = velocity.x - velocity.angular * lever
            face_speed = (
                velocity.x + tangent * velocity.z - velocity.angular * lever * (1.0 + tangent * tangent)
            )
            elastic = roller.stiffness * depth
            force = max(elastic - roller.damping * face_speed, 0.0)
            load[body].x += force
            load[body].torque -= force * lever
            totals.stored += 0.5 * elastic * depth
            totals.power += force * (face_speed - point_speed) - (force - elastic) * face_speed
            totals.penetration = max(totals.penetration, depth)
            roller.depth = depth
            roller.force = force
