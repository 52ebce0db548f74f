"""Builds a leg, or one of its parts, upright: knee centre at the origin, impact side towards +x."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.mechanics.force_laws.flesh_suspension import FleshSuspension
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.force_laws.ligament_cable import LigamentCable
from certkit.mechanics.legform.knee import join_knee

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.legform import Bone, Flesh, Legform
    from certkit.mechanics.legform.segments import Segment
    from certkit.mechanics.solver.world import Assembly


@dataclass(frozen=True)
class Joint:
    """A rotational spring of the leg: the law's row and its height above the knee centre."""

    row: int
    height: float
    part: str


@dataclass(frozen=True)
class Leg:
    """What was built, so that fixtures and channels can find it.

    Parameters
    ----------
    segments : tuple of Segment
        From top to bottom.
    bodies : tuple of int
        Their bodies.
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
        upper, lower = (b for b, s in zip(self.bodies, self.segments, strict=True) if s.part == "knee")
        return upper, lower


def add_leg(
    assembly: Assembly, legform: Legform, segments: Sequence[Segment], *, flesh: bool, damping: float = 0.0
) -> Leg:
    """Build the segments, their joints, the knee and, where fitted, the flesh."""
    counts: dict[str, int] = {}
    bodies = []
    for segment in segments:
        counts[segment.part] = counts.get(segment.part, 0) + 1
        bodies.append(
            assembly.add_body(
                f"{segment.part} {counts[segment.part]}",
                segment.mass,
                segment.inertia,
                (0.0, segment.centre, 0.0),
                damping=damping,
            )
        )
    joints: list[Joint] = []
    ligaments: dict[str, int] = {}
    knee_row = -1
    for upper, lower, a, b in zip(segments, segments[1:], bodies, bodies[1:], strict=False):
        if upper.part == lower.part == "knee":
            ligaments, knee_row = join_knee(assembly, legform, (a, b), (upper.centre, lower.centre))
            continue
        assembly.add_pivot(a, b, 0.0, upper.bottom)
        part = lower.part if upper.part == "knee" else upper.part
        bone = legform.femur if part == "femur" else legform.tibia
        factor = 1.0 if upper.part == lower.part else float(bone.block_joint)
        joints.append(Joint(_add_joint(assembly, bone, a, b, factor), upper.bottom, part))
        if flesh and legform.flesh.bending_stiffness is not None:
            _add_sleeve(assembly, legform.flesh, a, b, factor * bone.segments / bone.length)
    return Leg(
        segments=tuple(segments),
        bodies=tuple(bodies),
        joints=tuple(joints),
        ligaments=ligaments,
        knee_row=knee_row,
        flesh=_add_flesh(assembly, legform, segments, bodies) if flesh else (),
    )


def _add_joint(assembly: Assembly, bone: Bone, upper: int, lower: int, factor: float) -> int:
    stiffness = factor * bone.bending_stiffness * bone.segments / bone.length
    return assembly.add(
        JointSpring(
            upper=upper,
            lower=lower,
            stiffness=stiffness,
            damping=stiffness * bone.damping_time,
            cable_angle=bone.cable_angle,
            cable_stiffness=bone.cable_stiffness,
        )
    )


def _add_sleeve(assembly: Assembly, flesh: Flesh, upper: int, lower: int, curvature: float) -> None:
    """Let the sleeve bend beside a bone's joint, `curvature` (1/m) for an angle of one; no gauge feels it."""
    stiffness = curvature * (flesh.bending_stiffness or 0.0)
    assembly.add(
        JointSpring(
            upper=upper,
            lower=lower,
            stiffness=stiffness,
            damping=stiffness * (flesh.damping_time or 0.0),
            cable_angle=math.pi,
            cable_stiffness=0.0,
        )
    )


def _add_flesh(
    assembly: Assembly, legform: Legform, segments: Sequence[Segment], bodies: Sequence[int]
) -> tuple[int, ...]:
    """Put one mass on each segment, spread evenly over the leg's length, and tie neighbours together."""
    flesh = legform.flesh
    total = sum(segment.length for segment in segments)
    masses = []
    heights = []
    for i, (segment, bone) in enumerate(zip(segments, bodies, strict=True)):
        mass = flesh.mass * segment.length / total
        height = (segment.top + segment.bottom) / 2
        body = assembly.add_body(f"flesh {i + 1}", mass, 0.0, (0.0, height, 0.0))
        across, along = 2 * math.pi * flesh.across, 2 * math.pi * flesh.along
        assembly.add(
            FleshSuspension(
                bone=bone,
                flesh=body,
                height=height - segment.centre,
                stiffness_across=mass * across**2,
                stiffness_along=mass * along**2,
                damping_across=2 * flesh.damping_ratio * mass * across,
                damping_along=2 * flesh.damping_ratio * mass * along,
            )
        )
        masses.append(body)
        heights.append(height)
    if flesh.tension > 0:
        for upper, lower, top, bottom in zip(masses, masses[1:], heights, heights[1:], strict=False):
            length = top - bottom
            assembly.add(
                LigamentCable(upper=upper, lower=lower, length=length, stiffness=flesh.tension / length)
            )
    return tuple(masses)
