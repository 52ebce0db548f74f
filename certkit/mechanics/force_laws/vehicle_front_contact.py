"""The leg's flesh against the faces of a car front: sliding contact, pushing only, with friction.

Force on a strip as in `face_contact`. The front is cut into strips of constant height above the ground. A
strip's face moves with the group it belongs to or, between two neighbouring groups, with a mean of both: the
face stays one line without steps, and a force on it goes to both groups in the same shares, so no work is
lost.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.face_contact import press_strip, untilted_piece_at
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class VehicleFrontContact(ForceLaw, kw_only=True):
    """One strip of the front; all strips follow each other from top to bottom.

    Parameters
    ----------
    lower, upper : Body
        The groups that the strip moves with.
    face_x, face_z : float
        The strip's middle, where the groups' bodies stand at x = 0, m.
    share : float
        Of the upper group in the strip's motion.
    height : float
        h, m.
    compression : float
        k, N/m².
    layer : float
        t, m; without end for a bare bone.
    compacted_at : float
        d_c, m.
    wall : float
        w, N/m².
    loss : float
        λ.
    reversal : float
        v, m/s.
    thickness : float
        Of the flesh in front of the bone, m.
    friction : float
        μ.
    depth, force : State
        D (m) and F (N) now.
    """

    lower: Body
    upper: Body
    face_x: float
    face_z: float
    share: float
    height: float
    compression: float
    layer: float
    compacted_at: float
    wall: float
    loss: float
    reversal: float
    thickness: float
    friction: float
    depth: State = 0.0
    force: State = 0.0

    @staticmethod
    @compiled
    def forces(strips: Rows[VehicleFrontContact], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the contact of leg and front."""
        piece = 0
        for i in range(len(strips)):
            strip = strips[i]
            first, second = strip.lower, strip.upper
            share = strip.share
            strip.depth = 0.0
            strip.force = 0.0
            found = untilted_piece_at(now, strip.face_z, piece)
            if found < 0:
                continue
            piece = found
            depth, force, _, _ = press_strip(
                now,
                load,
                totals,
                piece,
                strip.face_x + (1.0 - share) * now.pose[first].x + share * now.pose[second].x,
                strip.face_z,
                (1.0 - share) * now.velocity[first].x + share * now.velocity[second].x,
                0.0,
                strip.height,
                strip.compression,
                strip.layer,
                strip.compacted_at,
                strip.wall,
                strip.loss,
                strip.reversal,
                strip.thickness,
                strip.friction,
            )
            load[first].x += (1.0 - share) * force
            load[second].x += share * force
            strip.depth = depth
            strip.force = force
