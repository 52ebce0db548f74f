"""Flesh compressed between bone and a face: it stiffens, ends at the bone, and gives back a part of its work.

Elastic force per unit height over the depth d of a layer of thickness t that is compacted at d_c < t:

    p(d) = k·d·(1 + (d/t)²) + w·max(d − d_c, 0)² / (2·(t − d_c))

with k its initial stiffness (N/m²). From d_c on the stiffness grows to w (N/m²), that of the wall behind the
flesh (its compacted rest, segment frame and bone), which it has where the flesh ends, at d = t.

On a leg tilted by θ the overlap D of leg and face along x is a depth d = D·cos θ across the leg, and a strip
of height h meets a length h / cos θ of it. It pushes with F = h·p·(1 + λ·tanh(ḋ/v)) along x, normal to the
leg's surface: internal friction of the rubber adds while the flesh is loaded, takes away while it is
unloaded, and above v hardly depends on the speed. A layer that returns the share r of its work when it
springs back (its rebound resilience) has λ = (1 − r) / (1 + r).

Source: a cubic spring is the simplest law that stiffens alike with depth; internal friction as a share of the
elastic force is the usual account of rubber's hysteresis. The numbers stand with their origin in the legform
document.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.leg_outline import piece_at, surface_at, surface_velocity

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


@compiled
def elastic(
    depth: float, compression: float, layer: float, compacted: float, wall: float
) -> tuple[float, float]:
    """Return the elastic force p (N/m) and the energy stored (J/m) per unit length; see the module."""
    ratio = depth / layer
    over = max(depth - compacted, 0.0)
    force = compression * depth * (1.0 + ratio * ratio)
    energy = compression * depth * depth * (0.5 + 0.25 * ratio * ratio)
    if over > 0.0:
        rest = 0.5 * wall * over * over / (layer - compacted)
        force += rest
        energy += rest * over / 3.0
    return force, energy


@compiled
def tilted(
    overlap: float, cosine: float, compression: float, layer: float, compacted: float, wall: float
) -> tuple[float, float, float]:
    """Return force along x, stored energy and its derivative by the tilt's cosine, all per unit height."""
    force, stored = elastic(overlap * cosine, compression, layer, compacted, wall)
    energy = stored / cosine
    return force, energy, (force * overlap - energy) / cosine


@compiled
def friction_share(closing: float, loss: float, reversal: float) -> float:
    """Return internal friction as a share of the elastic force, at a speed of compression ḋ in m/s."""
    return loss * math.tanh(closing / reversal)


class FleshCompression(ForceLaw, kw_only=True):
    """One strip of a face; the strips of a body follow each other from top to bottom.

    Parameters
    ----------
    carrier : Body
        What the face is fixed to.
    face_x, face_z : float
        The strip's middle from the carrier's centre of gravity, m.
    height : float
        h, m.
    compression : float
        k, N/m².
    layer : float
        t, m: of the flesh and a cover of the face together; without end for a bare bone.
    compacted_at : float
        d_c, m.
    wall : float
        w, N/m².
    loss : float
        λ.
    reversal : float
        v, m/s: speed of compression at which internal friction has come to three quarters of its full value.
    thickness : float
        Of the flesh in front of the bone, m.
    depth, force : State
        D (m) and F (N) now.
    """

    carrier: Body
    face_x: float
    face_z: float
    height: float
    compression: float
    layer: float
    compacted_at: float
    wall: float
    loss: float
    reversal: float
    thickness: float
    depth: State = 0.0
    force: State = 0.0

    @staticmethod
    @compiled
    def forces(strips: Rows[FleshCompression], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the forces of compressed flesh."""
        piece = 0
        for i in range(len(strips)):
            strip = strips[i]
            carrier = now.pose[strip.carrier]
            if i > 0 and strip.carrier != strips[i - 1].carrier:
                piece = 0
            z = carrier.z + strip.face_z
            strip.depth = 0.0
            strip.force = 0.0
            found = piece_at(now, z, piece)
            if found < 0:
                continue
            piece = found
            x, by_z, by_angle = surface_at(now, piece, z, strip.thickness)
            depth = x - carrier.x - strip.face_x
            if depth <= 0.0:
                continue
            body = now.outline[piece].body
            closing = surface_velocity(now, body, by_z, by_angle)
            closing -= now.velocity[strip.carrier].x + by_z * now.velocity[strip.carrier].z
            leg = now.pose[body]
            press, energy, by_cosine = tilted(
                depth, leg.cos, strip.compression, strip.layer, strip.compacted_at, strip.wall
            )
            press *= strip.height
            friction = press * friction_share(closing * leg.cos, strip.loss, strip.reversal)
            force = press + friction
            totals.stored += strip.height * energy
            totals.power += friction * closing
            totals.force += force
            totals.flesh_depth = max(totals.flesh_depth, depth * leg.cos / strip.layer)
            on_leg, on_carrier = load[body], load[strip.carrier]
            on_leg.x -= force
            on_leg.z -= force * by_z
            on_leg.torque -= force * by_angle - strip.height * by_cosine * leg.sin
            on_carrier.x += force
            on_carrier.z += force * by_z
            strip.depth = depth
            strip.force = force
