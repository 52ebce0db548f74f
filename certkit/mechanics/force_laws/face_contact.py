"""The leg's flesh against one strip of a car front's face: sliding contact, pushing only, with friction.

Force on the strip over depth and its rate, with what the flesh loses, as in `flesh_compression`, and friction
μ·F·tanh(v/v₀) against the sliding speed v along the leg.

The leg's surface goes over from one segment to the next within a short ramp, and fades out at the leg's ends:
where it jumped, strips that the leg slides along would gain or lose depth without work. All elastic forces
are the gradient of one stored energy, so that it is kept. Strips may be tilted against the leg, not the
force: it is along x.

Source: the compression law of the legform document; the ramps and the smoothing of friction are numerical
choices, none of which changes a peak by as much as a halved time step does.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.flesh_compression import friction_share, tilted
from certkit.mechanics.force_laws.leg_outline import STEEPEST, surface_at, surface_velocity

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import Instant, Load, Totals
    from certkit.mechanics.records import Rows

RAMP = 0.01
"""m: within this distance from a segment's end its surface goes over into the next one's."""

FADE = 0.2
"""Cosine: over this range above the steepest tilt that can be met, contact fades out."""

HALF = 0.5
"""Where less of the contact than this is left, at the leg's ends, its depth is that of no flesh."""

STICK = 0.1
"""v₀, m/s: sliding speed at which friction has come to three quarters of its full value."""


@compiled
def _end(now: Instant, piece: int, top: bool) -> float:  # noqa: FBT001  # compiled code takes no keywords
    """Return the height of a segment's upper or lower end."""
    leg = now.outline[piece]
    pose = now.pose[leg.body]
    return pose.z + (leg.top if top else leg.bottom) * pose.cos


@compiled
def untilted_piece_at(now: Instant, z: float, piece: int) -> int:
    """Return the first piece at or below `piece` that stands at height `z`; -1 where there is none.

    Unlike the other obstacles' search this one passes by segments that are tilted too far, for those below.
    """
    last = len(now.outline) - 1
    while piece <= last and z < _end(now, piece, False):
        piece += 1
    if piece > last or (piece == 0 and z > _end(now, 0, True)):
        return -1
    return piece


@compiled
def kept_when_tilted(cosine: float) -> tuple[float, float]:
    """Return how much of the contact a tilted segment keeps, and how that grows with the tilt's cosine."""
    kept = (cosine - STEEPEST) / FADE
    if kept >= 1.0:
        return 1.0, 0.0
    return max(kept, 0.0), (1.0 / FADE if kept > 0.0 else 0.0)


@compiled
def pieces_sharing(now: Instant, piece: int, z: float) -> tuple[int, int, float]:
    """Return the two pieces that share the surface at `z`, upper first, and the lower one's weight."""
    last = len(now.outline) - 1
    if piece < last:
        above = z - _end(now, piece, False)
        if above < RAMP:
            return piece, piece + 1, 0.5 * (1.0 - above / RAMP)
    if piece > 0:
        above = z - _end(now, piece - 1, False)
        if above > -RAMP:
            return piece - 1, piece, 0.5 * (1.0 - above / RAMP)
    return piece, piece, 0.0


@compiled
def kept_at_ends(now: Instant, piece: int, z: float) -> tuple[float, float]:
    """Return how much of the contact the leg's ends leave at `z`, and how that grows with their height."""
    last = len(now.outline) - 1
    if piece == 0:
        left = 0.5 * (_end(now, 0, True) - z) / RAMP
        if left < 1.0:
            return max(left, 0.0), 0.5 / RAMP
    if piece == last:
        left = 0.5 * (z - _end(now, last, False)) / RAMP
        if left < 1.0:
            return max(left, 0.0), -0.5 / RAMP
    return 1.0, 0.0


@compiled
def push_back(load: Rows[Load], body: int, force: float, by_z: float, by_angle: float) -> None:
    """Add a force along the gradient of the depth to a body of the leg."""
    on_leg = load[body]
    on_leg.x -= force
    on_leg.z -= force * by_z
    on_leg.torque -= force * by_angle


@compiled
def press_strip(  # noqa: PLR0913, PLR0915, PLR0917  # one contact, force by force; compiled code takes no bundles
    now: Instant,
    load: Rows[Load],
    totals: Totals,
    piece: int,
    face: float,
    z: float,
    speed: float,
    climbing: float,
    height: float,
    compression: float,
    layer: float,
    compacted_at: float,
    wall: float,
    loss: float,
    reversal: float,
    thickness: float,
    rubbing: float,
) -> tuple[float, float, float, float]:
    """Press the leg's surface on a strip of a face, and load the leg with it.

    Parameters
    ----------
    now, load, totals
        As every law has them.
    piece : int
        Segment whose surface stands at the strip's height, from `untilted_piece_at`.
    face, z, speed, climbing : float
        Place of the strip, m, and how fast it moves along x and z, m/s.
    height : float
        Of the strip, m.
    compression, layer, compacted_at, wall, loss, reversal, thickness : float
        Of the flesh, see `flesh_compression`.
    rubbing : float
        μ.

    Returns
    -------
    depth, force : float
        m, and N along +x on what carries the strip; both 0 where nothing is touched.
    by_height : float
        How the depth grows with the strip's place z where it stands.
    energy : float
        Stored, J.
    """
    upper, lower, weight = pieces_sharing(now, piece, z)
    above, below = now.outline[upper].body, now.outline[lower].body
    kept, gain = kept_when_tilted(now.pose[above].cos)
    kept_below, gain_below = kept_when_tilted(now.pose[below].cos)
    upright = (1.0 - weight) * kept + weight * kept_below
    if upright <= 0.0:
        return 0.0, 0.0, 0.0, 0.0
    x, by_z, by_angle = surface_at(now, upper, z, thickness)
    across = other_z = other_angle = 0.0
    if weight > 0.0:
        other, other_z, other_angle = surface_at(now, lower, z, thickness)
        across = other - x
        x += weight * across
    depth = x - face
    part, growth = kept_at_ends(now, piece, z)
    if depth <= 0.0 or part <= 0.0:
        return 0.0, 0.0, 0.0, 0.0
    cosine = (1.0 - weight) * now.pose[above].cos + weight * now.pose[below].cos
    press, energy, by_cosine = tilted(depth, cosine, compression, layer, compacted_at, wall)
    press *= part * upright * height
    energy *= height
    by_cosine *= part * upright * height
    closing = (1.0 - weight) * surface_velocity(now, above, by_z, by_angle)
    closing += weight * surface_velocity(now, below, other_z, other_angle)
    by_height = -(1.0 - weight) * by_z - weight * other_z - (across * 0.5 / RAMP if weight > 0.0 else 0.0)
    closing += by_height * climbing - speed
    friction = press * friction_share(closing * cosine, loss, reversal)
    force = press + friction
    totals.stored += part * upright * energy
    totals.power += friction * closing
    totals.force += force
    if part * upright > HALF:
        totals.flesh_depth = max(totals.flesh_depth, depth * cosine / layer)
    body = now.outline[piece].body
    push_back(load, above, (1.0 - weight) * force, by_z, by_angle)
    push_back(load, below, weight * force, other_z, other_angle)
    # The ramp moves with the lower end of the upper segment, and what the ends leave with the ends.
    up = press * across + part * energy * (kept_below - kept)
    up += by_cosine * (now.pose[below].cos - now.pose[above].cos)
    up *= 0.5 / RAMP
    load[above].z -= up
    load[above].torque += up * now.outline[upper].bottom * now.pose[above].sin
    load[above].torque += (part * energy * gain + by_cosine) * (1.0 - weight) * now.pose[above].sin
    load[below].torque += (part * energy * gain_below + by_cosine) * weight * now.pose[below].sin
    end = now.outline[piece].top if growth > 0.0 else now.outline[piece].bottom
    load[body].z -= upright * energy * growth
    load[body].torque += upright * energy * growth * end * now.pose[body].sin
    arm = x - now.pose[body].x
    slip = now.velocity[body].z + now.velocity[body].angular * arm
    rub = rubbing * force * math.tanh(slip / STICK)
    load[body].z -= rub
    load[body].torque -= rub * arm
    totals.power += rub * slip
    return depth, force, by_height, part * upright * energy
