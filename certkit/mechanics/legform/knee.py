"""The knee: condyles in troughs, four preloaded ligaments, a parallel stiffness."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.force_laws.condyle_contact import CondyleContact
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.force_laws.ligament_cable import LigamentCable
from certkit.mechanics.force_laws.sliding_guide import SlidingGuide

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform
    from certkit.definitions.legform_parts import Knee
    from certkit.mechanics.solver.world import Assembly

TANGENTIAL = 0.5
"""Tangential over normal contact stiffness: it only lets friction hold, so any stiff value serves."""


def join_knee(
    assembly: Assembly, legform: Legform, blocks: tuple[int, int], centres: tuple[float, float]
) -> tuple[dict[str, int], int]:
    """Join the two knee blocks; return the ligaments' rows and the row of the parallel stiffness."""
    knee = legform.knee
    upper, lower = centres
    rows = {}
    for name, ligament in knee.ligaments.items():
        (ax, az), (bx, bz) = ligament.femur, ligament.tibia
        rows[name] = assembly.add(
            LigamentCable(
                upper=blocks[0],
                lower=blocks[1],
                upper_x=ax,
                upper_z=az - upper,
                lower_x=bx,
                lower_z=bz - lower,
                length=math.hypot(ax - bx, az - bz),
                **ligament.numbers(),
            )
        )
    pressed, shear = resting_forces(knee)
    condyles = knee.condyles
    for side, (x, force) in enumerate(zip((-condyles.offset, condyles.offset), pressed, strict=True)):
        held = min(max(shear[side], -condyles.friction * force), condyles.friction * force)
        assembly.add(
            CondyleContact(
                upper=blocks[0],
                lower=blocks[1],
                condyle_x=x,
                condyle_z=condyles.radius - upper,
                trough_x=x,
                # The preload has pressed the blocks together before the test.
                trough_z=condyles.trough_radius + max(force, 0.0) / condyles.stiffness - lower,
                clearance=condyles.trough_radius - condyles.radius,
                radius=condyles.radius,
                stiffness=condyles.stiffness,
                damping=condyles.damping,
                friction=condyles.friction,
                tangential_stiffness=TANGENTIAL * condyles.stiffness,
                slip_spring=held / (TANGENTIAL * condyles.stiffness),
            )
        )
    if knee.guide is not None:
        assembly.add(
            SlidingGuide(
                upper=blocks[0],
                lower=blocks[1],
                upper_x=knee.guide.offset,
                upper_z=-upper,
                lower_x=knee.guide.offset,
                free_travel=knee.guide.free_travel,
                stiffness=knee.guide.stiffness,
                damping=knee.guide.damping,
            )
        )
    row = assembly.add(
        JointSpring(
            upper=blocks[0],
            lower=blocks[1],
            stiffness=knee.parallel_stiffness,
            damping=0.0,
        )
    )
    return rows, row


def resting_forces(knee: Knee) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return normal and tangential forces of the two contacts that balance the ligaments' preloads.

    Left contact (-x) first. Normal forces press the femur block up; tangential ones are those on the
    friction springs, which share the ligaments' pull along x in proportion to the normal forces.
    """
    pull_x = pull_z = moment = 0.0
    for ligament in knee.ligaments.values():
        (ax, az), (bx, bz) = ligament.femur, ligament.tibia
        length = math.hypot(ax - bx, az - bz)
        tension = max(float(ligament.preload), 0.0)  # below zero it is slack
        fx, fz = -tension * (ax - bx) / length, -tension * (az - bz) / length
        pull_x += fx
        pull_z += fz
        moment += ax * fz - az * fx
    # On the femur block, about the knee centre: N1 + N2 = -pull_z; offset·(N2 - N1) + moment = 0.
    total, difference = -pull_z, -moment / knee.condyles.offset
    left, right = (total - difference) / 2, (total + difference) / 2
    share = pull_x / total if total > 0 else 0.0
    # The contact's tangent is +x where its normal points down, and a positive spring pulls the femur block
    # to -x.
    return (left, right), (share * left, share * right)
