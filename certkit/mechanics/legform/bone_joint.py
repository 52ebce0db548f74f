"""What joins two segments of a leg: a bone's own spring, a joint between two parts, or a rigid connection.

Within a bone the stiffness is k = EI·n/L (bending stiffness EI, n segments over the length L), at the knee
block times the bone's `block joint`; its damping is k·(damping time). Where the bone's damper lies beside its
core, the spring that the gauges feel has none, and a second one has nothing else.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.definitions.legform import KNEE
from certkit.mechanics.force_laws.joint_spring import JointSpring

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform
    from certkit.definitions.legform_parts import Bone, PartJoint


def is_rigid(legform: Legform, upper: str, lower: str) -> bool:
    """Tell whether segments of two neighbouring parts are one body: bones without a joint between them."""
    return upper != lower and KNEE not in {upper, lower} and legform.parts[upper].joint is None


def part_joint(legform: Legform, upper: str, lower: str) -> PartJoint | None:
    """Return the joint between two parts; None within a bone, at the knee and where they are rigid."""
    return None if upper == lower or KNEE in {upper, lower} else legform.parts[upper].joint


def jointed_bone(legform: Legform, upper: str, lower: str) -> tuple[Bone, float]:
    """Return the bone of a joint within it, or at the knee block, and how much stiffer that joint is."""
    bone = legform.parts[lower if upper == KNEE else upper]
    return bone, 1.0 if upper == lower or bone.block_joint is None else float(bone.block_joint)


def _stiffness(bone: Bone, factor: float) -> float:
    """Return k = EI·n/L times how much stiffer the joint is, N·m/rad."""
    return factor * bone.bending_stiffness * bone.segments / bone.length


def damper_beside(legform: Legform, bodies: tuple[int, int], upper: str, lower: str) -> JointSpring | None:
    """Return the damper that no gauge feels, None where the joint has none."""
    if part_joint(legform, upper, lower) is not None:
        return None
    bone, factor = jointed_bone(legform, upper, lower)
    if bone.damper == "in the core":
        return None
    return JointSpring(
        upper=bodies[0],
        lower=bodies[1],
        stiffness=0.0,
        damping=_stiffness(bone, factor) * bone.damping_time,
    )


def joint_spring(legform: Legform, bodies: tuple[int, int], upper: str, lower: str) -> JointSpring:
    """Return the rotational spring between two bodies, segments of these parts."""
    joint = part_joint(legform, upper, lower)
    if joint is not None:
        return JointSpring(
            upper=bodies[0],
            lower=bodies[1],
            stiffness=joint.stiffness,
            damping=joint.stiffness * joint.damping_time,
        )
    bone, factor = jointed_bone(legform, upper, lower)
    stiffness = _stiffness(bone, factor)
    return JointSpring(
        upper=bodies[0],
        lower=bodies[1],
        stiffness=stiffness,
        damping=stiffness * bone.damping_time if bone.damper == "in the core" else 0.0,
        cable_angle=math.pi if bone.cable_angle is None else bone.cable_angle,
        cable_stiffness=0.0 if bone.cable_stiffness is None else bone.cable_stiffness,
    )
