"""A piece of flesh on its bone segment: a spring and damper across the bone, another pair along it.

Force F = k·u + c·u̇ in each direction, with the displacement u of the flesh from its place at rest, seen
from the bone (m), stiffness k (N/m) and damping c (N·s/m). It acts where the flesh is, on both bodies, so
that linear and angular momentum are kept exactly. The flesh is a point mass.

Source: a damped oscillator on the bone, its frequencies and damping ratio from the legform document:
k = m·(2πf)², c = 2·ζ·m·2πf.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class FleshSuspension(ForceLaw, kw_only=True):
    """One piece of flesh.

    Parameters
    ----------
    bone, flesh : Body
    height : float
        Of the flesh at rest above the bone's centre of gravity, m.
    offset : float
        Of the flesh at rest from the bone's axis, towards the impact side, m.
    stiffness_across, stiffness_along : float
        k, N/m.
    damping_across, damping_along : float
        c, N·s/m.
    shift_across, shift_along : State
        u now, m.
    """

    bone: Body
    flesh: Body
    height: float
    offset: float
    stiffness_across: float
    stiffness_along: float
    damping_across: float
    damping_along: float
    shift_across: State = 0.0
    shift_along: State = 0.0

    @staticmethod
    @compiled
    def forces(pieces: Rows[FleshSuspension], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the springs' and dampers' forces between flesh and bone."""
        stored = power = 0.0
        for i in range(len(pieces)):
            piece = pieces[i]
            bone, flesh = now.pose[piece.bone], now.pose[piece.flesh]
            c, s = bone.cos, bone.sin
            dx = flesh.x - bone.x
            dz = flesh.z - bone.z
            # The flesh in the bone's frame, and how fast it moves there.
            rx, rz = c * dx + s * dz, c * dz - s * dx
            of_bone, of_flesh = now.velocity[piece.bone], now.velocity[piece.flesh]
            vx = of_flesh.x - of_bone.x
            vz = of_flesh.z - of_bone.z
            turn = of_bone.angular
            across, along = rx - piece.offset, rz - piece.height
            across_rate = c * vx + s * vz + turn * rz
            along_rate = c * vz - s * vx - turn * rx
            damping_across = piece.damping_across * across_rate
            damping_along = piece.damping_along * along_rate
            # Force on the bone in its own frame, then in space.
            fx = piece.stiffness_across * across + damping_across
            fz = piece.stiffness_along * along + damping_along
            stored += 0.5 * (piece.stiffness_across * across * across + piece.stiffness_along * along * along)
            power += damping_across * across_rate + damping_along * along_rate
            gx, gz = c * fx - s * fz, s * fx + c * fz
            on_bone, on_flesh = load[piece.bone], load[piece.flesh]
            on_bone.x += gx
            on_bone.z += gz
            on_bone.torque += rx * fz - rz * fx
            on_flesh.x -= gx
            on_flesh.z -= gz
            piece.shift_across = across
            piece.shift_along = along
        totals.stored += stored
        totals.power += power
