"""Honeycomb crushed against the leg: elastic up to its crush strength, then crushed for good.

Force on a strip of height h: F = p·w·h·min(d_e/d_y, 1), with the crush strength p (Pa), the contact width w
of the segment it meets (m), the elastic depth d_e = d - d_p and the depth d_y at which it yields (m). What
goes beyond d_y adds to the crushed depth d_p, which stays: energy p·w·h per metre is dissipated. It pushes
only.

Source: perfectly plastic crush at constant pressure, the idealisation by which honeycomb is specified with
one crush strength.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.leg_outline import piece_at, surface_at

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


@dataclass(kw_only=True)
class Honeycomb(ForceLaw):
    """One strip of the honeycomb's face; the strips of a body follow each other from top to bottom.

    Parameters
    ----------
    carrier : Body
        What the honeycomb is fixed to.
    face_x, face_z : float
        The strip's middle, not yet crushed, from the carrier's centre of gravity, m.
    height : float
        h, m.
    strength : float
        p, Pa.
    elastic_depth : float
        d_y, m.
    thickness : float
        Of the flesh in front of the bone, m.
    crushed : State
        d_p, m: remembered from step to step.
    force : State
        F now, N.
    """

    carrier: Body
    face_x: float
    face_z: float
    height: float
    strength: float
    elastic_depth: float
    thickness: float
    crushed: State = 0.0
    force: State = 0.0

    @staticmethod
    @compiled
    def forces(strips: Rows[Honeycomb], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the honeycomb's forces and crush it further."""
        piece = 0
        for i in range(len(strips)):
            strip = strips[i]
            carrier = now.pose[strip.carrier]
            if i > 0 and strip.carrier != strips[i - 1].carrier:
                piece = 0
            z = carrier.z + strip.face_z
            strip.force = 0.0
            found = piece_at(now, z, piece)
            if found < 0:
                continue
            piece = found
            x, by_z, by_angle = surface_at(now, piece, z, strip.thickness)
            yield_depth = strip.elastic_depth
            elastic = x - carrier.x - strip.face_x - strip.crushed
            if elastic <= 0.0:
                continue
            strength = strip.strength * now.outline[piece].width * strip.height
            if elastic > yield_depth:
                totals.dissipated += strength * (elastic - yield_depth)
                strip.crushed += elastic - yield_depth
                elastic = yield_depth
            force = strength * elastic / yield_depth
            totals.stored += 0.5 * force * elastic
            totals.force += force
            on_leg, on_carrier = load[now.outline[piece].body], load[strip.carrier]
            on_leg.x -= force
            on_leg.z -= force * by_z
            on_leg.torque -= force * by_angle
            on_carrier.x += force
            on_carrier.z += force * by_z
            strip.force = force
