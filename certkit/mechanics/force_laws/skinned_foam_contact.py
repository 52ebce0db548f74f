"""A leg's skinned foam against a bar or the faces of a front: pushing only, sliding, with friction.

Strips follow an outline as in `folding_face_contact`; one that keeps its form has a path of one point. Where
a strip overlaps the leg's unpressed surface by D along x, the skin is pressed in by u ≥ D, and what the foam
and the neighbours press back with (`foam_layer`) is the contact force

    R = h·q(u·cos θ) + Σ Q(neighbours) ≥ 0,  and R = 0 wherever u > D

h is the strip's height that no other strip stands in front of. So a crest takes its surroundings with it. The
skin has no inertia: u is in equilibrium at every step. Neighbours are the strips that are met, by height;
flesh beside all strips presses on nothing.

What the foam does not give back, and what the outline's own change takes up, counts as dissipated.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.face_contact import (
    HALF,
    RAMP,
    STICK,
    kept_at_ends,
    kept_when_tilted,
    pieces_sharing,
    push_back,
    untilted_piece_at,
)
from certkit.mechanics.force_laws.foam_layer import left_by_memory
from certkit.mechanics.force_laws.folding_strip import move_strip, seen_height, sort_by_height
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.leg_outline import surface_at
from certkit.mechanics.force_laws.skin_equilibrium import (
    foam_of,
    line_up,
    link_below,
    press_skin,
    remember,
)

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


@compiled
def _place(strip: SkinnedFoamContact, now: Instant) -> None:
    """Write down where the strip stands now; it moves with both its groups."""
    lower, upper = now.pose[strip.lower].x, now.pose[strip.upper].x
    moved = (1.0 - strip.share) * lower + strip.share * upper - strip.rest
    move_strip(strip, now, moved, lower - upper)


@compiled
def _meet(strips: Rows[SkinnedFoamContact], now: Instant, tallest: float) -> None:
    """Write down which strips the leg's surface stands at, how deep, and how much of them it meets."""
    piece = 0
    for place in range(len(strips)):
        strip = strips[strips[place].order]
        strip.size = 0.0
        strip.depth = 0.0
        piece = untilted_piece_at(now, strip.z, max(piece, 0))
        if piece < 0:
            continue
        part, _ = kept_at_ends(now, piece, strip.z)
        upper, lower, weight = pieces_sharing(now, piece, strip.z)
        kept, _ = kept_when_tilted(now.pose[now.outline[upper].body].cos)
        kept_below, _ = kept_when_tilted(now.pose[now.outline[lower].body].cos)
        strip.grip = part * ((1.0 - weight) * kept + weight * kept_below)
        if strip.grip <= 0.0:
            continue
        strip.size = strip.grip * seen_height(strips, place, tallest)
        strip.piece = piece
        x, _, _ = surface_at(now, upper, strip.z, strip.thickness)
        other, _, _ = surface_at(now, lower, strip.z, strip.thickness)
        strip.depth = (1.0 - weight) * x + weight * other - strip.face
        strip.cosine = (1.0 - weight) * now.pose[now.outline[upper].body].cos
        strip.cosine += weight * now.pose[now.outline[lower].body].cos


@compiled
def _load_leg(
    strip: SkinnedFoamContact, now: Instant, load: Rows[Load], totals: Totals, stored: float, by_cosine: float
) -> float:
    """Press a strip's force on the leg and its groups; return how the depth grows with the strip's height.

    As `face_contact.press_strip`; `stored` is the foam's energy (J), `by_cosine` its derivative.
    """
    piece, z, force = strip.piece, strip.z, strip.force
    upper, lower, weight = pieces_sharing(now, piece, z)
    above, below = now.outline[upper].body, now.outline[lower].body
    kept, gain = kept_when_tilted(now.pose[above].cos)
    kept_below, gain_below = kept_when_tilted(now.pose[below].cos)
    part, growth = kept_at_ends(now, piece, z)
    upright = (1.0 - weight) * kept + weight * kept_below
    energy = stored / upright  # of the part that the ends leave
    x, by_z, by_angle = surface_at(now, upper, z, strip.thickness)
    across = other_z = other_angle = 0.0
    if weight > 0.0:
        other, other_z, other_angle = surface_at(now, lower, z, strip.thickness)
        across = other - x
        x += weight * across
    by_height = -(1.0 - weight) * by_z - weight * other_z - (across * 0.5 / RAMP if weight > 0.0 else 0.0)
    push_back(load, above, (1.0 - weight) * force, by_z, by_angle)
    push_back(load, below, weight * force, other_z, other_angle)
    up = force * across + energy * (kept_below - kept)
    up += by_cosine * (now.pose[below].cos - now.pose[above].cos)
    up *= 0.5 / RAMP
    load[above].z -= up
    load[above].torque += up * now.outline[upper].bottom * now.pose[above].sin
    load[above].torque += (energy * gain + by_cosine) * (1.0 - weight) * now.pose[above].sin
    load[below].torque += (energy * gain_below + by_cosine) * weight * now.pose[below].sin
    body = now.outline[piece].body
    end = now.outline[piece].top if growth > 0.0 else now.outline[piece].bottom
    pull = stored / part * growth
    load[body].z -= pull
    load[body].torque += pull * end * now.pose[body].sin
    arm = x - now.pose[body].x
    slip = now.velocity[body].z + now.velocity[body].angular * arm
    rub = strip.friction * force * math.tanh(slip / STICK)
    load[body].z -= rub
    load[body].torque -= rub * arm
    totals.power += rub * slip
    totals.force += force
    load[strip.lower].x += (1.0 - strip.load_share) * force
    load[strip.upper].x += strip.load_share * force
    return by_height


class SkinnedFoamContact(ForceLaw, kw_only=True):
    """One strip of a face.

    Parameters
    ----------
    lower, upper : Body
        The groups that the strip moves with; the ground where it stands still.
    share : float
        Of the upper group in the strip's motion.
    load_share : float
        Of the upper group in its load. Where that is another share than in its motion, what the groups move
        against each other takes up work.
    rest : float
        Where the groups' bodies stand before they are moved, in these shares, m.
    in_start, in_points, back_start, back_points : int
        The strip's path, see `recorded_path`: x against the groups, z and height over the displacement.
    foam_start, foam_points : int
        The foam's loading curve, N/m over m.
    layer : float
        Thickness of the foam and a cover of the face together, m.
    hysteresis, shape, shear, skin : float
        H, s, N and A, see `foam_layer`.
    loss, reversal : float
        λ and v: share by which internal friction adds to the foam's force, see `flesh_compression`.
    recovery : float
        r, m: see `foam_layer`; 0 where the foam's memory stays.
    thickness : float
        Of the flesh in front of the bone, m.
    friction : float
        μ.
    order : int
        Row of the strip that comes at this row's place from the top; the law keeps it sorted.
    depth, force : State
        D (m) and R (N) now.
    pressed, most : State
        u (m), and Wₘ (J/m).
    before, felt : State
        u and R a step ago.
    by_cosine : State
        Derivative of the foam's energy by the cosine, J.
    leaned, gripped : State
        Cosine, and what the leg's ends and tilt leave, a step ago.
    left : State
        m, see `foam_layer`: what the foam's memory leaves of its shear; of the last step.
    apart, parting : State
        How far the lower group stands before the upper one, and by how much more than a step ago, m.
    largest, x, z, face, shift, climb : State
        As in `FoldingFaceContact`, m.
    height, size, grip, cosine : State
        The strip's height, and how much of it is met (m); what the leg's ends and tilt leave of a contact;
        cosine of the leg's tilt.
    stored : State
        Energy of the foam, and of the link to the next strip of the chain, J.
    pivot, right, coupled : State
        Of the elimination: diagonal, right side (N), and stiffness to the next strip (N/m).
    piece, held : int
        Piece of the leg's outline that is met; 1 where the strip presses, 0 where the skin is free.
    chain : int
        Row of the strip that comes at this row's place from the top among those that are met.
    """

    lower: Body
    upper: Body
    share: float
    load_share: float
    rest: float
    in_start: int
    in_points: int
    back_start: int
    back_points: int
    foam_start: int
    foam_points: int
    layer: float
    hysteresis: float
    shape: float
    loss: float
    reversal: float
    recovery: float
    shear: float
    skin: float
    thickness: float
    friction: float
    order: int
    depth: State = 0.0
    force: State = 0.0
    pressed: State = 0.0
    most: State = 0.0
    apart: State = 0.0
    parting: State = 0.0
    largest: State = 0.0
    x: State = 0.0
    z: State = 0.0
    face: State = 0.0
    shift: State = 0.0
    climb: State = 0.0
    height: State = 0.0
    size: State = 0.0
    grip: State = 0.0
    cosine: State = 1.0
    stored: State = 0.0
    pivot: State = 0.0
    right: State = 0.0
    coupled: State = 0.0
    before: State = 0.0
    felt: State = 0.0
    by_cosine: State = 0.0
    leaned: State = 1.0
    gripped: State = 0.0
    left: State = 1.0
    piece: int = 0
    held: int = 0
    chain: int = 0

    @staticmethod
    @compiled
    def forces(strips: Rows[SkinnedFoamContact], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the contact of leg and faces."""
        lost = tallest = 0.0
        for i in range(len(strips)):
            strip = strips[i]
            _place(strip, now)
            tallest = max(tallest, strip.height)
            strip.before, strip.felt = strip.pressed, strip.force
            strip.leaned, strip.gripped = strip.cosine, strip.grip
            strip.force = 0.0
            lost += strip.stored
            strip.stored = 0.0
        sort_by_height(strips)
        _meet(strips, now, tallest)
        count = line_up(strips)
        press_skin(strips, now, count)
        for k in range(count):
            strip = strips[strips[k].chain]
            press, _, stored, work = foam_of(strip, now)
            remember(strip, work)
            strip.left = left_by_memory(work, strip.most, strip.hysteresis, strip.shape)
            by_cosine = (press * strip.pressed - stored) / strip.cosine
            by_height = _load_leg(strip, now, load, totals, stored, by_cosine)
            # What the leg's turning and ends take from the foam is no loss.
            lost += 0.5 * (strip.by_cosine + by_cosine) * (strip.cosine - strip.leaned)
            lost += stored / strip.grip * (strip.grip - strip.gripped)
            strip.by_cosine = by_cosine
            felt = 0.5 * (strip.felt + strip.force)
            lost += felt * (strip.pressed - strip.before + strip.shift - by_height * strip.climb)
            lost += felt * (strip.load_share - strip.share) * strip.parting
            if k < count - 1:
                _, _, energy = link_below(strips, k)
                stored += energy
            strip.stored = stored
            lost -= stored
            totals.stored += stored
            if strip.force > 0.0 and strip.grip > HALF:
                totals.flesh_depth = max(totals.flesh_depth, strip.depth * strip.cosine / strip.layer)
        totals.dissipated += lost
