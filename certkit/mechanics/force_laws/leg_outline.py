"""The leg's surface as obstacles meet it: which segment stands at a height, and how far forward.

Obstacles are cut into strips of constant height in space. A strip looks up the segment at its height, so
its force passes smoothly from segment to segment as the leg tilts and slides. With the surface at
x(z) = x₀ - (z - z₀)·tan θ + e/cos θ on a segment at (x₀, z₀, θ) with half depth e, forces follow the gradient
of the depth, which makes them normal to the surface and conservative.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import Instant

STEEPEST = 0.3
"""Cosine: a segment that is tilted by more than about 70° is not met by any obstacle."""


@compiled
def piece_at(now: Instant, z: float, piece: int) -> int:
    """Return the first piece of the outline at or below `piece` that stands at height `z`; -1 for none.

    Strips must come from top to bottom, each starting from the piece of the one above it.
    """
    last = len(now.outline)
    while piece < last:
        leg = now.outline[piece]
        pose = now.pose[leg.body]
        if pose.cos < STEEPEST:
            return -1
        if z >= pose.z + leg.bottom * pose.cos:
            above = z > pose.z + leg.top * pose.cos
            return -1 if above and piece == 0 else piece
        piece += 1
    return -1


@compiled
def surface_at(now: Instant, piece: int, z: float, thickness: float) -> tuple[float, float, float]:
    """Return where the leg's surface stands at height `z`, and how that follows the segment's pose.

    Returns
    -------
    x, by_height, by_angle : float
        Place of the surface, flesh of this `thickness` included (m), and its derivatives by the segment's
        height and angle (by its x: one).
    """
    leg = now.outline[piece]
    pose = now.pose[leg.body]
    c = pose.cos
    tangent = pose.sin / c
    lever = z - pose.z
    off = (leg.face + thickness) / c
    return pose.x - lever * tangent + off, tangent, off * tangent - lever / (c * c)


@compiled
def surface_velocity(now: Instant, body: int, by_height: float, by_angle: float) -> float:
    """Return how fast a segment's surface moves along x at a height that stays, m/s; see `surface_at`."""
    velocity = now.velocity[body]
    return velocity.x + by_height * velocity.z + by_angle * velocity.angular
