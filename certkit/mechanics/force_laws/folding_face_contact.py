"""The leg's flesh against faces that fold as they are pushed in: sliding, pushing only, with friction.

A face is a line of points. Each point's place (x, z) is tabulated over its group's displacement (m), from
finite elements; strips lie between the points and move with their group and on its outline. So the place
where the leg presses wanders over a group, and from group to group, as the face folds. Where a fold lies over
another strip, or a flange behind the face, only the one in front is met. Force on a strip as in
`face_contact`.

A load between the last node of a group and the first of the next is on both of them, in the strip's share.
What the outline's own change takes up, contact force times the strip's movement against its group, and what
the two groups move against each other, is counted as dissipated: it is work on the folding face.

Source: step 4 of the seed paper (section 3) measures the front that the leg bends to; the outline says where
that front is.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.face_contact import press_strip, untilted_piece_at
from certkit.mechanics.force_laws.folding_strip import move_strip, seen_height, sort_by_height
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


@compiled
def _place(strips: Rows[FoldingFaceContact], now: Instant) -> None:
    """Write down where the strips stand now, and how much of each can be seen."""
    tallest = 0.0
    for i in range(len(strips)):
        strip = strips[i]
        at = now.pose[strip.group].x
        move_strip(strip, now, at - strip.rest, at - now.pose[strip.partner].x)
        tallest = max(tallest, strip.height)
    sort_by_height(strips)
    for place in range(len(strips)):
        strip = strips[strips[place].order]
        seen = seen_height(strips, place, tallest)
        strip.growth = seen - strip.seen
        strip.seen = seen


class FoldingFaceContact(ForceLaw, kw_only=True):
    """One strip of a face.

    Parameters
    ----------
    group, partner : Body
        What it moves with, and what its load is shared with.
    share : float
        Of the partner in the load.
    rest : float
        Where the group's body stands before it is moved, m.
    in_start, in_points, back_start, back_points : int
        The strip's path, see `recorded_path`: x against the group, z and height over the displacement.
    compression, layer, compacted_at, wall, loss, reversal : float
        Of the flesh, see `flesh_compression`.
    thickness : float
        Of the flesh in front of the bone, m.
    friction : float
        μ.
    order : int
        Row of the strip that comes at this row's place from the top; the law keeps it sorted.
    depth, force : State
        d (m) and F (N) now.
    apart, parting : State
        How far the group stands before its partner, and by how much more than a step ago, m.
    largest : State
        Largest displacement of the group so far, m.
    x, z : State
        The strip's place against its group now, m.
    face, height, seen : State
        Where it stands, how high it is, and how much of that no other strip stands in front of, m.
    shift, climb, growth : State
        How much x, z and what is seen have changed with the outline since the step before, m.
    density : State
        Energy stored over height now, J/m.
    """

    group: Body
    partner: Body
    share: float
    rest: float
    in_start: int
    in_points: int
    back_start: int
    back_points: int
    compression: float
    layer: float
    compacted_at: float
    wall: float
    loss: float
    reversal: float
    thickness: float
    friction: float
    order: int
    depth: State = 0.0
    force: State = 0.0
    apart: State = 0.0
    parting: State = 0.0
    largest: State = 0.0
    x: State = 0.0
    z: State = 0.0
    face: State = 0.0
    height: State = 0.0
    seen: State = 0.0
    shift: State = 0.0
    climb: State = 0.0
    growth: State = 0.0
    density: State = 0.0

    @staticmethod
    @compiled
    def forces(strips: Rows[FoldingFaceContact], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the contact of leg and folding faces."""
        _place(strips, now)
        piece = 0
        above = math.inf
        for i in range(len(strips)):
            strip = strips[i]
            z, height = strip.z, strip.seen
            shift, climb, growth = strip.shift, strip.climb, strip.growth
            before = strip.force
            strip.depth = 0.0
            strip.force = 0.0
            if z > above:  # a fold stands above the strip before it
                piece = 0
            above = z
            found = untilted_piece_at(now, z, piece)
            if found < 0:
                piece = 0
                continue
            piece = found
            depth, force, by_height, energy = press_strip(
                now,
                load,
                totals,
                piece,
                strip.face,
                z,
                now.velocity[strip.group].x + shift / now.step,
                climb / now.step,
                height,
                strip.compression,
                strip.layer,
                strip.compacted_at,
                strip.wall,
                strip.loss,
                strip.reversal,
                strip.thickness,
                strip.friction,
            )
            if before > 0.0 and force > 0.0:
                given = shift - by_height * climb + strip.share * strip.parting
                totals.dissipated += 0.5 * (before + force) * given
            density = energy / height if height > 0.0 else strip.density
            last = strip.density if height > growth else density  # it was not to be seen before
            totals.dissipated -= 0.5 * (density + last) * growth
            strip.density = density
            load[strip.group].x += (1.0 - strip.share) * force
            load[strip.partner].x += strip.share * force
            strip.depth = depth
            strip.force = force
