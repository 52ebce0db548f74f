"""The faces that are drawn of a front stand where the solver's strips stand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from support.synthetic_extraction import group

from certkit.definitions.loading.library import load
from certkit.definitions.vehicle import FaceOutline, ReturningOutline
from certkit.documents.extraction import OutlineResult
from certkit.documents.face_outline import outline_at
from certkit.mechanics.force_laws.folding_face_contact import FoldingFaceContact
from certkit.mechanics.force_laws.recorded_contact import RecordedContact
from certkit.mechanics.rig.face_outlines import outline_strips
from certkit.mechanics.rig.recorded_tables import add_path, add_tables
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import Assembly

IN = {
    0.0: [(0.02, 0.3), (0.021, 0.304)],
    0.05: [(0.065, 0.302), (0.06, 0.305)],
    0.1: [(0.13, 0.31), (0.11, 0.309)],
}
BACK = {0.3: [(0.06, 0.306), (0.05, 0.308)], 0.7: [(0.1, 0.311), (0.08, 0.308)]}

PUSH, STEP, UNTIL = 0.01, 1e-5, 0.032


@pytest.mark.parametrize("furthest", [0.002, 0.06, 0.1, 0.12])
def test_a_drawn_face_stands_where_its_strips_do(furthest: float) -> None:
    """A face of 1 kg is pushed in, as far as said, and pulled back."""
    vehicle = load("vehicle", "fe-front").document
    face = vehicle.groups["F4"].model_copy(
        update={
            "outlines": [FaceOutline.model_construct(at=at, points=line) for at, line in IN.items()],
            "springing_back": [
                ReturningOutline.model_construct(share=share, points=line) for share, line in BACK.items()
            ],
        }
    )
    strips = outline_strips(vehicle.model_copy(update={"groups": {"F": face}}), 0.0)
    assembly = Assembly()
    body = assembly.add_body("F", 1.0, 0.0, (0.0, 0.0, 0.0), guided=True)
    force = furthest / PUSH**2
    times = np.array([0.0, 1e-9, PUSH, PUSH + 1e-9, 1.0])
    pushes = np.array([0.0, force, force, -force, -force])
    start, points = add_tables(assembly, times, np.column_stack([pushes, np.zeros(5)]))
    assembly.add(RecordedContact(group=body, start=start, points=points, on_leg=0, thickness=0.0))
    for number, strip in enumerate(strips):
        assembly.add(
            FoldingFaceContact(
                group=body,
                partner=body,
                share=0.0,
                rest=0.0,
                compression=1e6,
                layer=math.inf,
                compacted_at=math.inf,
                wall=0.0,
                loss=0.0,
                reversal=1.0,
                thickness=0.03,
                friction=0.0,
                order=number,
                **add_path(assembly, (strip.at, strip.pushed), (strip.shares, strip.back)),
            )
        )
    world = assembly.finish()
    rows = range(len(strips))
    probes = [world.place(FoldingFaceContact, row, state) for state in ("face", "z") for row in rows]
    run = run_world(world, Plan(STEP, UNTIL, 0.0), tracked=[body], probes=probes)
    places = run.readings.reshape(len(run.readings), 2, len(strips)).mean(axis=2)
    moved = run.tracks[:, 0, 0]
    largest = np.maximum.accumulate(moved)
    assert largest[-1] == pytest.approx(furthest, rel=0.01)
    assert moved[-1] < 0.4 * furthest
    known = {
        "outlines": tuple(OutlineResult(at=at, points=tuple(line)) for at, line in IN.items()),
        "springing_back": tuple(OutlineResult(at=at, points=tuple(line)) for at, line in BACK.items()),
    }
    drawn = group("F", "fascia", 0.1, 0.3).model_copy(update=known)
    for k in range(10, len(moved), 150):
        middle = np.mean(outline_at(drawn, moved[k], largest[k]), axis=0)
        assert middle == pytest.approx(places[k], abs=2e-4 * furthest)
