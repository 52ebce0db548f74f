"""What is to be said of a simulated test that its verdict passes over.

Steel cables that came tight, a knee that is not at rest, a rig or a leg that no such test would be made with,
a leg that falls through the ground, flesh that is pressed twice.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.fixtures.free_flight import FreeFlight
from certkit.definitions.legform import KNEE, WHOLE
from certkit.grading.preconditions import grade_precondition
from certkit.reasons import Reason

if TYPE_CHECKING:
    from certkit.bench.setup import Setup
    from certkit.definitions.vehicle import Vehicle
    from certkit.mechanics import Simulation

BALANCED = 1e-3
"""Share of the ligaments' whole pull by which their preloads may miss their balance."""


def leg_remarks(setup: Setup, simulation: Simulation) -> list[Reason]:
    """Return the remarks on the leg of a run."""
    return [
        *_outside_conditions(setup),
        *_through_the_ground(setup, simulation),
        *_tight_cables(setup, simulation),
        *_knee_at_rest(setup),
        *([] if setup.vehicle is None else flesh_pressed_twice(setup.vehicle)),
    ]


def _outside_conditions(setup: Setup) -> list[Reason]:
    """Tell what the procedure's preconditions would not let to the test, as they would not a real one."""
    known: dict[str, float] = {}
    for fixture in setup.procedure.rig.fixtures():
        known |= fixture.settings()
    if setup.procedure.specimen.part == WHOLE:
        fitted = setup.procedure.specimen.flesh == "fitted"
        known["legform mass"] = setup.legform.whole_mass(flesh=fitted)
    said = []
    for precondition in setup.procedure.preconditions:
        value = known.get(precondition.quantity)
        reason = None if value is None else grade_precondition(precondition, value).coded_reason
        if reason is not None:
            told = reason.parameters
            said.append(
                Reason.of(
                    "model-outside-condition",
                    quantity=told["quantity"],
                    value=told["value"],
                    unit=told["unit"],
                    lower=told["lower"],
                    upper=told["upper"],
                )
            )
    return said


def _through_the_ground(setup: Setup, simulation: Simulation) -> list[Reason]:
    """Tell a leg that falls farther than its flight begins above the ground, which no model has."""
    flight = setup.procedure.rig.fixture(FreeFlight)
    if flight is None:
        return []
    run, leg = simulation.run, simulation.rig.leg
    _, place, angle = run.frames[:, leg.bodies[-1]].T
    end = place + np.cos(angle) * (leg.bottom - leg.centres[-1])
    below = end[0] - end - float(flight.end_above_ground)
    first = np.flatnonzero(below > 0)
    if not first.size:
        return []
    time = 1e3 * (float(run.frame_time[first[0]]) - run.contact)
    return [Reason.of("leg-below-ground", depth=1e3 * float(below.max()), time=time)]


def flesh_pressed_twice(vehicle: Vehicle) -> list[Reason]:
    """Tell faces at one height: the leg meets the foremost, and in the model its one flesh yields to each."""
    return [
        Reason.of("faces-at-one-height", front=one, behind=other, shared=1e3 * shared)
        for one, other, shared in vehicle.shared_heights
    ]


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
