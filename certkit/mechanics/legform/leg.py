"""Builds a leg, or one of its parts, upright: knee centre at the origin, impact side towards +x."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.definitions.legform import KNEE
from certkit.mechanics.force_laws.flesh_suspension import FleshSuspension
from certkit.mechanics.force_laws.ligament_cable import LigamentCable
from certkit.mechanics.legform.bone_joint import (
    damper_beside,
    is_rigid,
    joint_spring,
    jointed_bone,
    part_joint,
)
from certkit.mechanics.legform.knee import join_knee
from certkit.mechanics.legform.segments import assembled
from certkit.mechanics.legform.sleeve import add_sleeve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.legform import Legform
    from certkit.definitions.legform_parts import FarFlesh, Flesh
    from certkit.mechanics.legform.segments import Segment
    from certkit.mechanics.solver.world import Assembly


class Joint(Struct, frozen=True):
    """A rotational spring of the leg: the law's row and its height above the knee centre."""

    row: int
    height: float
    part: str


class Leg(Struct, frozen=True):
    """What was built, so that fixtures and channels can find it.

    Parameters
    ----------
    segments : tuple of Segment
        From top to bottom.
    bodies : tuple of int
        Their bodies; segments of two parts that are joined rigidly share one.
    centres : tuple of float
        Height of the centre of gravity of each one's body.
    joints : tuple of Joint
        Rotational springs of the bones, from top to bottom; at a knee block's end with the block's stiffness.
    ligaments : dict of str to int
        Rows of `LigamentCable`.
    knee_row : int
        Row of `JointSpring` between the knee blocks, -1 without a knee.
    flesh : tuple of int
        Bodies of the flesh, empty where it is not fitted.
    """

    segments: tuple[Segment, ...]
    bodies: tuple[int, ...]
    centres: tuple[float, ...]
    joints: tuple[Joint, ...]
    ligaments: dict[str, int]
    knee_row: int
    flesh: tuple[int, ...]

    @property
    def top(self) -> float:
        """Return the height of the upper end."""
        return self.segments[0].top

    @property
    def bottom(self) -> float:
        """Return the height of the lower end."""
        return self.segments[-1].bottom

    @property
    def blocks(self) -> tuple[int, int]:
        """Return the bodies of the knee's femur and tibia block."""
        upper, lower = (b for b, s in zip(self.bodies, self.segments, strict=True) if s.part == KNEE)
        return upper, lower


def add_leg(
    assembly: Assembly, legform: Legform, segments: Sequence[Segment], *, flesh: bool, damping: float = 0.0
) -> Leg:
    """Build the segments, their joints, the knee and, where fitted, the flesh."""
    bodies, centres = _add_bodies(assembly, legform, segments, damping)
    joints: list[Joint] = []
    ligaments: dict[str, int] = {}
    knee_row = -1
    for upper, lower, a, b in zip(segments, segments[1:], bodies, bodies[1:], strict=False):
        if a == b:
            continue
        if upper.part == lower.part == KNEE:
            ligaments, knee_row = join_knee(assembly, legform, (a, b), (upper.centre, lower.centre))
            continue
        assembly.add_pivot(a, b, 0.0, upper.bottom)
        part = lower.part if upper.part == KNEE else upper.part
        row = assembly.add(joint_spring(legform, (a, b), upper.part, lower.part))
        joints.append(Joint(row, upper.bottom, part))
        damper = damper_beside(legform, (a, b), upper.part, lower.part)
        if damper is not None:
            assembly.add(damper)
        if flesh and part_joint(legform, upper.part, lower.part) is None:
            bone, factor = jointed_bone(legform, upper.part, lower.part)
            face = upper.depth / 2 if upper.part != KNEE else lower.depth / 2
            add_sleeve(assembly, legform.flesh, (a, b), factor * bone.segments / bone.length, face)
    return Leg(
        segments=tuple(segments),
        bodies=bodies,
        centres=centres,
        joints=tuple(joints),
        ligaments=ligaments,
        knee_row=knee_row,
        flesh=_add_flesh(assembly, legform, segments, bodies, centres) if flesh else (),
    )


def _add_bodies(
    assembly: Assembly, legform: Legform, segments: Sequence[Segment], damping: float
) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Add a body a segment, one for segments held rigidly; return bodies and their centres."""
    counts: dict[str, int] = {}
    bodies: list[int] = []
    centres: list[float] = []
    for rigid in _rigid_runs(legform, segments):
        first = rigid[0].part
        counts[first] = counts.get(first, 0) + 1
        mass, centre, inertia = (
            (rigid[0].mass, rigid[0].centre, rigid[0].inertia) if len(rigid) == 1 else assembled(rigid)
        )
        body = assembly.add_body(
            f"{first} {counts[first]}", mass, inertia, (0.0, centre, 0.0), damping=damping
        )
        bodies += [body] * len(rigid)
        centres += [centre] * len(rigid)
    return tuple(bodies), tuple(centres)


def _rigid_runs(legform: Legform, segments: Sequence[Segment]) -> list[list[Segment]]:
    """Return the segments in runs that are held rigidly: across parts without a joint between them."""
    runs: list[list[Segment]] = []
    for segment in segments:
        if runs and is_rigid(legform, runs[-1][-1].part, segment.part):
            runs[-1].append(segment)
        else:
            runs.append([segment])
    return runs


def _suspension(
    bone: int, body: int, place: tuple[float, float], mass: float, flesh: Flesh | FarFlesh
) -> FleshSuspension:
    """Return the springs and dampers that hold a piece of flesh at a place from the bone's centre."""
    across, along = 2 * math.pi * flesh.across, 2 * math.pi * flesh.along
    return FleshSuspension(
        bone=bone,
        flesh=body,
        offset=place[0],
        height=place[1],
        stiffness_across=mass * across**2,
        stiffness_along=mass * along**2,
        damping_across=2 * flesh.damping_ratio * mass * across,
        damping_along=2 * flesh.damping_ratio * mass * along,
    )


def _far_masses(flesh: Flesh, segments: Sequence[Segment]) -> list[float]:
    """Return the mass behind each segment: evenly along the leg, less or none where the knee is left open."""
    if flesh.far_side is None:
        return [0.0] * len(segments)
    knee = 1.0 if flesh.far_side.at_knee is None else float(flesh.far_side.at_knee)
    lengths = [segment.length * (knee if segment.is_knee else 1.0) for segment in segments]
    return [flesh.mass * flesh.far_side.share * length / sum(lengths) for length in lengths]


def _add_flesh(
    assembly: Assembly,
    legform: Legform,
    segments: Sequence[Segment],
    bodies: Sequence[int],
    centres: Sequence[float],
) -> tuple[int, ...]:
    """Put one mass on each segment, spread evenly over the leg's length, and tie neighbours together."""
    flesh = legform.flesh
    total = sum(segment.length for segment in segments)
    behind = _far_masses(flesh, segments)
    masses = []
    heights = []
    for i, (segment, bone, centre) in enumerate(zip(segments, bodies, centres, strict=True)):
        mass = flesh.mass * segment.length / total
        height = (segment.top + segment.bottom) / 2
        far, offset = flesh.far_side, 0.0
        if far is not None:
            face = segment.depth / 2 if flesh.face is None else float(flesh.face)
            offset = face + flesh.thickness / 2
            place = (-offset, height, 0.0)
            if behind[i] > 0.0:
                body = assembly.add_body(f"far flesh {i + 1}", behind[i], 0.0, place)
                assembly.add(_suspension(bone, body, (-offset, height - centre), behind[i], far))
            mass *= 1 - far.share
        body = assembly.add_body(f"flesh {i + 1}", mass, 0.0, (offset, height, 0.0))
        assembly.add(_suspension(bone, body, (offset, height - centre), mass, flesh))
        masses.append(body)
        heights.append(height)
    if flesh.tension > 0:
        for upper, lower, top, bottom in zip(masses, masses[1:], heights, heights[1:], strict=False):
            length = top - bottom
            assembly.add(
                LigamentCable(upper=upper, lower=lower, length=length, stiffness=flesh.tension / length)
            )
    return tuple(masses)
