"""Contact forces that were recorded elsewhere, over time: on a vehicle's group, or on the leg at some height.

With them a front or a leg is driven alone, so that each can be judged without the other. On the leg the force
F(t) acts at the height z(t) normal to its surface, as a contact does. Outside the record there is none.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.face_contact import untilted_piece_at
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.leg_outline import surface_at, surface_velocity
from certkit.mechanics.force_laws.piecewise_linear import held

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class RecordedContact(ForceLaw, kw_only=True):
    """One recorded contact.

    Parameters
    ----------
    group : Body
        What it presses on; the ground: the leg.
    start, points : int
        Its record among the curves: force over time (s, N), and as many points of height over time (s, m).
    on_leg : int
        1 where it presses on the leg.
    thickness : float
        Of the flesh in front of the bone, m.
    force : State
        F now, N.
    """

    group: Body
    start: int
    points: int
    on_leg: int
    thickness: float
    force: State = 0.0

    @staticmethod
    @compiled
    def forces(contacts: Rows[RecordedContact], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the recorded forces."""
        for i in range(len(contacts)):
            contact = contacts[i]
            force = held(now.curves, contact.start, contact.points, now.time)
            contact.force = force
            totals.force += force
            if contact.on_leg == 0:
                load[contact.group].x += force
                totals.power -= force * now.velocity[contact.group].x
                continue
            z = held(now.curves, contact.start + contact.points, contact.points, now.time)
            piece = untilted_piece_at(now, z, 0)
            if force == 0.0 or piece < 0:
                continue
            body = now.outline[piece].body
            _, by_z, by_angle = surface_at(now, piece, z, contact.thickness)
            on_leg = load[body]
            on_leg.x -= force
            on_leg.z -= force * by_z
            on_leg.torque -= force * by_angle
            totals.power += force * surface_velocity(now, body, by_z, by_angle)
