"""Flesh (or a cover) pressed between the leg and a flat face: progressive, pushing only.

Force on a strip of height h: F = k·h·d·(1 + (d/d₀)²) with the depth d by which leg and face overlap (m),
the compression stiffness k per height (N/m²) and the depth d₀ at which the stiffness has doubled (m). It is
normal to the leg's surface and elastic: stored energy k·h·d²·(½ + ¼·(d/d₀)²).

Source: a cubic spring, the simplest law that stiffens alike with depth; its two numbers stand with their
origin in the legform document.
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
class FleshCompression(ForceLaw):
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
    stiffening_depth : float
        d₀, m.
    thickness : float
        Of the flesh in front of the bone, m.
    depth, force : State
        d (m) and F (N) now.
    """

    carrier: Body
    face_x: float
    face_z: float
    height: float
    compression: float
    stiffening_depth: float
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
            ratio = depth / strip.stiffening_depth
            stiffness = strip.compression * strip.height
            force = stiffness * depth * (1.0 + ratio * ratio)
            totals.stored += stiffness * depth * depth * (0.5 + 0.25 * ratio * ratio)
            totals.force += force
            on_leg, on_carrier = load[now.outline[piece].body], load[strip.carrier]
            on_leg.x -= force
            on_leg.z -= force * by_z
            on_leg.torque -= force * by_angle
            on_carrier.x += force
            on_carrier.z += force * by_z
            strip.depth = depth
            strip.force = force
