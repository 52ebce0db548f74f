"""Honeycomb crushed against the leg: elastic up to its crush strength, then crushed for good.

Force on a strip of height h: F = p·w·h·min(d_e/d_y, 1), with the crush strength p (Pa), the contact width w
of the segment it meets (m), the elastic depth d_e = d - d_p and the depth d_y at which it yields (m). What
goes beyond d_y adds to the crushed depth d_p, which stays: energy p·w·h per metre is dissipated. It pushes
only. Where the edge of a thicker part slides into a strip, that is cut without work of this force. Where the
leg wears its flesh, both are in series: d is what the flesh leaves, whose force (`flesh_compression`) is the
same.

Source: perfectly plastic crush at constant pressure, the idealisation by which honeycomb is specified with
one crush strength.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.flesh_compression import elastic, friction_share, tilted
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.leg_outline import piece_at, surface_at, surface_velocity

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


HALVINGS = 40
"""Of the interval in which the flesh's depth is looked for: down to a thousandth of a nanometre."""


@compiled
def flesh_depth(approach: float, cosine: float, strength: float, scale: float, strip: Honeycomb) -> float:
    """Return the depth of flesh along x (m) at which its force and the honeycomb's are the same.

    Parameters
    ----------
    approach : float
        Depth of flesh and elastic honeycomb together, m.
    cosine : float
        Of the leg's tilt.
    strength : float
        p·w, N/m.
    scale : float
        Factor of the flesh's elastic force: one and its friction.
    strip : Honeycomb
    """
    low, high = 0.0, approach
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        press, _energy = elastic(
            middle * cosine, strip.compression, strip.layer, strip.compacted_at, strip.wall
        )
        if scale * press > strength * min((approach - middle) / strip.elastic_depth, 1.0):
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


class Honeycomb(ForceLaw, kw_only=True):
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
        Of the flesh in front of the bone, m; 0 where it is off.
    compression, layer, compacted_at, wall, loss, reversal : float
        Of the flesh, where it is fitted, as in `FleshCompression`.
    crushed : State
        d_p, m: remembered from step to step.
    force : State
        F now, N.
    flesh_depth : State
        Depth of the flesh now, m.
    piece : State
        Piece of the leg's surface that stood in front of it a step ago.
    """

    carrier: Body
    face_x: float
    face_z: float
    height: float
    strength: float
    elastic_depth: float
    thickness: float
    compression: float = 0.0
    layer: float = 1.0
    compacted_at: float = 1.0
    wall: float = 0.0
    loss: float = 0.0
    reversal: float = 1.0
    crushed: State = 0.0
    force: State = 0.0
    flesh_depth: State = 0.0
    piece: State = -1.0

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
            stays, strip.piece = strip.piece == piece, piece
            x, by_z, by_angle = surface_at(now, piece, z, strip.thickness)
            yield_depth = strip.elastic_depth
            approach = x - carrier.x - strip.face_x - strip.crushed
            if approach <= 0.0:
                strip.flesh_depth = 0.0
                continue
            body = now.outline[piece].body
            strength = strip.strength * now.outline[piece].width
            soft = by_cosine = 0.0
            leg = now.pose[body]
            if strip.thickness > 0.0:
                closing = surface_velocity(now, body, by_z, by_angle)
                closing -= now.velocity[strip.carrier].x + by_z * now.velocity[strip.carrier].z
                scale = 1.0 + friction_share(closing * leg.cos, strip.loss, strip.reversal)
                soft = flesh_depth(approach, leg.cos, strength, scale, strip)
                press, energy, by_cosine = tilted(
                    soft, leg.cos, strip.compression, strip.layer, strip.compacted_at, strip.wall
                )
                totals.stored += energy * strip.height
                totals.power += press * (scale - 1.0) * strip.height * (soft - strip.flesh_depth) / now.step
                totals.flesh_depth = max(totals.flesh_depth, soft * leg.cos / strip.layer)
            strip.flesh_depth = soft
            deep = approach - soft
            strength *= strip.height
            if deep > yield_depth:
                if stays or deep < 2.0 * yield_depth:
                    totals.dissipated += strength * (deep - yield_depth)
                # Else the edge of a thicker part has slid into the strip and cut it: no work of this force.
                strip.crushed += deep - yield_depth
                deep = yield_depth
            force = strength * deep / yield_depth
            totals.stored += 0.5 * force * deep
            totals.force += force
            on_leg, on_carrier = load[body], load[strip.carrier]
            on_leg.x -= force
            on_leg.z -= force * by_z
            on_leg.torque -= force * by_angle - strip.height * by_cosine * leg.sin
            on_carrier.x += force
            on_carrier.z += force * by_z
            strip.force = force
