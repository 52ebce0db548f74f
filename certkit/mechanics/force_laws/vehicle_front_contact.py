"""The leg's flesh against the faces of a car front: sliding contact, pushing only, with friction.

Force on a strip over depth and its rate, with what the flesh loses, as in `flesh_compression`, and friction
μ·F·tanh(v/v₀) against the sliding speed v along the leg.

The front is cut into strips of constant height above the ground. A strip's face moves with the group it
belongs to or, between two neighbouring groups, with a mean of both: the face stays one line without steps,
and a force on it goes to both groups in the same shares, so no work is lost. The leg's surface likewise goes
over from one segment to the next within a short ramp, and fades out at the leg's ends: where it jumped,
strips that the leg slides along would gain depth without work. All elastic forces are the gradient of one
stored energy, so that it is kept.

Source: the compression law of the legform document; the ramps and the smoothing of friction are numerical
choices, none of which changes a peak by as much as a halved time step does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.flesh_compression import friction_share, tilted
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.leg_outline import STEEPEST, surface_at, surface_velocity

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State

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
def _kept_when_tilted(cosine: float) -> tuple[float, float]:
    """Return how much of the contact a tilted segment keeps, and how that grows with the tilt's cosine."""
    kept = (cosine - STEEPEST) / FADE
    if kept >= 1.0:
        return 1.0, 0.0
    return max(kept, 0.0), (1.0 / FADE if kept > 0.0 else 0.0)


@compiled
def _pieces_sharing(now: Instant, piece: int, z: float) -> tuple[int, int, float]:
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
def _kept_at_ends(now: Instant, piece: int, z: float) -> tuple[float, float]:
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
def _push_back(load: Rows[Load], body: int, force: float, by_z: float, by_angle: float) -> None:
    """Add a force along the gradient of the depth to a body of the leg."""
    on_leg = load[body]
    on_leg.x -= force
    on_leg.z -= force * by_z
    on_leg.torque -= force * by_angle


@dataclass(kw_only=True)
class VehicleFrontContact(ForceLaw):
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
    thickness: float
    friction: float
    depth: State = 0.0
    force: State = 0.0

    @staticmethod
    @compiled
    def forces(  # noqa: PLR0915  # one contact, force by force
        strips: Rows[VehicleFrontContact], now: Instant, load: Rows[Load], totals: Totals
    ) -> None:
        """Add the contact of leg and front."""
        piece = 0
        for i in range(len(strips)):
            strip = strips[i]
            first, second = strip.lower, strip.upper
            share = strip.share
            face = strip.face_x + (1.0 - share) * now.pose[first].x + share * now.pose[second].x
            z = strip.face_z
            strip.depth = 0.0
            strip.force = 0.0
            found = untilted_piece_at(now, z, piece)
            if found < 0:
                continue
            piece = found
            upper, lower, weight = _pieces_sharing(now, piece, z)
            above, below = now.outline[upper].body, now.outline[lower].body
            kept, gain = _kept_when_tilted(now.pose[above].cos)
            kept_below, gain_below = _kept_when_tilted(now.pose[below].cos)
            upright = (1.0 - weight) * kept + weight * kept_below
            if upright <= 0.0:
                continue
            x, by_z, by_angle = surface_at(now, upper, z, strip.thickness)
            across = other_z = other_angle = 0.0
            if weight > 0.0:
                other, other_z, other_angle = surface_at(now, lower, z, strip.thickness)
                across = other - x
                x += weight * across
            depth = x - face
            part, growth = _kept_at_ends(now, piece, z)
            if depth <= 0.0 or part <= 0.0:
                continue
            cosine = (1.0 - weight) * now.pose[above].cos + weight * now.pose[below].cos
            press, energy, by_cosine = tilted(
                depth, cosine, strip.compression, strip.layer, strip.compacted_at, strip.wall
            )
            press *= part * upright * strip.height
            energy *= strip.height
            by_cosine *= part * upright * strip.height
            closing = (1.0 - weight) * surface_velocity(now, above, by_z, by_angle)
            closing += weight * surface_velocity(now, below, other_z, other_angle)
            closing -= (1.0 - share) * now.velocity[first].x + share * now.velocity[second].x
            friction = press * friction_share(closing * cosine, strip.loss)
            force = press + friction
            totals.stored += part * upright * energy
            totals.power += friction * closing
            totals.force += force
            if part * upright > HALF:
                totals.flesh_depth = max(totals.flesh_depth, depth * cosine / strip.layer)
            body = now.outline[piece].body
            _push_back(load, above, (1.0 - weight) * force, by_z, by_angle)
            _push_back(load, below, weight * force, other_z, other_angle)
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
            rub = strip.friction * force * math.tanh(slip / STICK)
            load[body].z -= rub
            load[body].torque -= rub * arm
            totals.power += rub * slip
            load[first].x += (1.0 - share) * force
            load[second].x += share * force
            strip.depth = depth
            strip.force = force
