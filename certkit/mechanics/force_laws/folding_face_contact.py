"""The leg's flesh against faces that fold as they are pushed in: sliding, pushing only, with friction.

A face is a line of points. Each point's place (x, z) is tabulated over its group's displacement (m), from
finite elements; strips lie between the points and move with their group and on its outline. So the place
where the leg presses wanders over a group, and from group to group, as the face folds. Where a fold lies over
another strip, or a flange behind the face, only the one in front is met. Force on a strip as in
`face_contact`.

A load beside the edge of two groups is on both of them, in the strip's share. What the outline's own change
takes up, contact force times the strip's movement against its group, and what the two groups move against
each other, is counted as dissipated: it is work on the folding face.

Source: step 4 of the seed paper (section 3) measures the front that the leg bends to; the outline says where
that front is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.face_contact import press_strip, untilted_piece_at
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.recorded_path import on_path

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


@compiled
def _place(strip: FoldingFaceContact, now: Instant) -> None:
    """Write down where the strip stands now, how high it is, and what of that is its own change."""
    moved = now.pose[strip.group].x - strip.rest
    strip.largest = max(strip.largest, moved)
    apart = now.pose[strip.group].x - now.pose[strip.partner].x
    strip.parting = apart - strip.apart
    strip.apart = apart
    x = on_path(now.curves, strip, 0, moved, strip.largest)
    z = on_path(now.curves, strip, 1, moved, strip.largest)
    strip.shift, strip.climb = x - strip.x, z - strip.z
    strip.x, strip.z = x, z
    strip.face = moved + x
    strip.whole = max(on_path(now.curves, strip, 2, moved, strip.largest), 0.0)


@compiled
def _show(strips: Rows[FoldingFaceContact], i: int) -> None:
    """Write down how much of the strip's height no other strip stands in front of."""
    strip = strips[i]
    low, high = strip.z - 0.5 * strip.whole, strip.z + 0.5 * strip.whole
    hidden = 0.0
    for k in range(len(strips)):
        other = strips[k]
        before = other.face < strip.face or (other.face == strip.face and k < i)
        if k != i and before:
            top = min(high, other.z + 0.5 * other.whole)
            hidden += max(top - max(low, other.z - 0.5 * other.whole), 0.0)
    seen = max(strip.whole - hidden, 0.0)
    strip.growth = seen - strip.height
    strip.height = seen


@dataclass(kw_only=True, eq=False, repr=False)
class FoldingFaceContact(ForceLaw):
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
    depth, force : State
        d (m) and F (N) now.
    apart, parting : State
        How far the group stands before its partner, and by how much more than a step ago, m.
    largest : State
        Largest displacement of the group so far, m.
    x, z : State
        The strip's place against its group now, m.
    face, whole, height : State
        Where it stands, how high it is, and how much of that no other strip stands in front of, m.
    shift, climb, growth : State
        How much x, z and height have changed with the outline since the step before, m.
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
    depth: State = 0.0
    force: State = 0.0
    apart: State = 0.0
    parting: State = 0.0
    largest: State = 0.0
    x: State = 0.0
    z: State = 0.0
    face: State = 0.0
    whole: State = 0.0
    height: State = 0.0
    shift: State = 0.0
    climb: State = 0.0
    growth: State = 0.0
    density: State = 0.0

    @staticmethod
    @compiled
    def forces(strips: Rows[FoldingFaceContact], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the contact of leg and folding faces."""
        for i in range(len(strips)):
            _place(strips[i], now)
        for i in range(len(strips)):
            _show(strips, i)
        piece = 0
        above = math.inf
        for i in range(len(strips)):
            strip = strips[i]
            z, height = strip.z, strip.height
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
