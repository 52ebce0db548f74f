"""What is to be said of a leg that its model passes over: cables that came tight, a knee not at rest."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.legform import KNEE, WHOLE
from certkit.reasons import Reason

if TYPE_CHECKING:
    from certkit.bench.setup import Setup
    from certkit.mechanics import Simulation

BALANCED = 1e-3
"""Share of the ligaments' whole pull by which their preloads may miss their balance."""


def leg_remarks(setup: Setup, simulation: Simulation) -> list[Reason]:
    """Return the remarks on the leg of a run."""
    return [*_tight_cables(setup, simulation), *_knee_at_rest(setup)]


def _tight_cables(setup: Setup, simulation: Simulation) -> list[Reason]:
    """Tell each bone whose cables acted: their angle is that of one joint, however many a bone has."""
    angles: dict[str, float] = {}
    for joint in simulation.rig.leg.joints:
        bent = float(np.abs(simulation.readings[f"angle {joint.row}"]).max(initial=0.0))
        angles[joint.part] = max(angles.get(joint.part, 0.0), bent)
    said = []
    for part, bent in angles.items():
        bone = setup.legform.parts[part]
        if bone.cable_angle is not None and bone.cable_stiffness and bent > bone.cable_angle:
            limit = math.degrees(bone.cable_angle)
            said.append(Reason.of("cables-tight", part=part, angle=math.degrees(bent), limit=limit))
    return said


def _knee_at_rest(setup: Setup) -> list[Reason]:
    """Tell preloads that contact and friction cannot hold where the knee was put together."""
    from certkit.mechanics.legform.knee import resting_forces  # noqa: PLC0415  # a graded test has no model

    if setup.procedure.specimen.part not in {WHOLE, KNEE}:
        return []
    pressed, shear = resting_forces(setup.legform.knee)
    whole = sum(max(float(ligament.preload), 0.0) for ligament in setup.legform.knee.ligaments.values())
    if min(pressed) < -BALANCED * whole:
        return [Reason.of("knee-bends-at-rest", pull=-min(pressed))]
    friction = float(setup.legform.knee.condyles.friction)
    held = friction * sum(pressed)
    if abs(sum(shear)) > held + BALANCED * whole:
        return [Reason.of("knee-slides-at-rest", pull=abs(sum(shear)), held=held)]
    return []
