"""What a front's folding faces, sheets and recorded contacts do, seen on one or two bodies at a time."""

from __future__ import annotations

import math

import numpy as np
import pytest

from certkit.definitions.fixtures.rig_builder import GROUND
from certkit.identification.sheet_law import SheetLaw, sheet_law
from certkit.mechanics.force_laws.folding_face_contact import FoldingFaceContact
from certkit.mechanics.force_laws.law import OutlinePiece
from certkit.mechanics.force_laws.recorded_contact import RecordedContact
from certkit.mechanics.force_laws.sheet_link import SheetLink
from certkit.mechanics.rig.recorded_tables import add_path, add_tables
from certkit.mechanics.solver.time_loop import Plan, Trajectory, run_world
from certkit.mechanics.solver.world import Assembly

STEP = 1e-5
NOTHING = (np.array([1.0]), np.zeros((1, 2)))


def pushed(
    force: float, duration: float, mass: float, *, sheet: dict[str, float] | None = None
) -> Trajectory:
    """Push a mass for a while, held by a sheet to the ground where one is given."""
    assembly = Assembly()
    body = assembly.add_body("mass", mass, 0.0, (0.0, 0.0, 0.0), guided=True)
    time = np.array([0.0, 1e-9, duration, duration + 1e-9, 1.0])
    values = np.array([0.0, force, force, 0.0, 0.0])
    start, points = add_tables(assembly, time, np.column_stack([values, np.zeros(5)]))
    assembly.add(RecordedContact(group=body, start=start, points=points, on_leg=0, thickness=0.0))
    if sheet is not None:
        way = (np.array([0.0, 0.01]), np.array([[0.0, 0.0], [0.02, sheet["force"]]]))
        assembly.add(
            SheetLink(
                first=body,
                second=GROUND,
                first_rest=0.0,
                second_rest=0.0,
                stiffness=sheet["stiffness"],
                damping=sheet["damping"],
                **add_path(assembly, way, NOTHING),
            )
        )
    return run_world(assembly.finish(), Plan(STEP, 0.02, 0.0), tracked=[body])


def test_a_recorded_force_gives_a_mass_its_impulse_and_no_more() -> None:
    run = pushed(500.0, 0.004, 2.0)
    speed = np.gradient(run.tracks[:, 0, 0], STEP)
    assert speed[-10] == pytest.approx(500.0 * 0.004 / 2.0, rel=0.01)


def test_a_sheet_on_its_recorded_path_gives_the_recorded_force() -> None:
    # The path's shortening is what the body's displacement makes of it: x₀ = 2ξ = X, so nothing deviates.
    run = pushed(500.0, 0.02, 2.0, sheet={"force": 400.0, "stiffness": 1e5, "damping": 0.0})
    x = run.tracks[:, 0, 0]
    at = int(np.argmin(np.abs(x - 0.01)))
    acceleration = np.gradient(np.gradient(x, STEP), STEP)
    assert 2.0 * acceleration[at] == pytest.approx(500.0 - 400.0 * 0.01 / 0.02, rel=0.02)


def test_a_sheet_keeps_the_energy_of_what_it_is_pushed_with() -> None:
    run = pushed(500.0, 0.004, 2.0, sheet={"force": 100.0, "stiffness": 1e4, "damping": 5.0})
    total = run.kinetic + run.stored.sum(axis=1) + run.dissipated.sum(axis=1)
    assert np.abs(total).max() < 0.01 * run.kinetic.max()


def slid(back: float, contact_force: float, force: float = 500.0) -> Trajectory:
    """Push a mass for 2 ms against a path that adds a force on its way back; a contact's where it says so."""
    assembly = Assembly()
    body = assembly.add_body("mass", 2.0, 0.0, (0.0, 0.0, 0.0), guided=True)
    time = np.array([0.0, 1e-9, 0.002, 0.002 + 1e-9, 1.0])
    values = np.column_stack([[0.0, force, force, 0.0, 0.0], np.zeros(5)])
    start, points = add_tables(assembly, time, values)
    assembly.add(RecordedContact(group=body, start=start, points=points, on_leg=0, thickness=0.0))
    way = (np.array([0.0, 0.01]), np.array([[0.0, 0.0], [0.02, 4000.0]]))
    returning = (np.array([0.0, 1.0]), np.array([[0.0, back], [0.0, 0.0]]))
    assembly.add(
        SheetLink(
            first=body,
            second=GROUND,
            first_rest=0.0,
            second_rest=0.0,
            stiffness=4e5,
            damping=20.0,
            contact_force=contact_force,
            **add_path(assembly, way, returning),
        )
    )
    return run_world(assembly.finish(), Plan(STEP, 0.02, 0.0), tracked=[body])


def test_a_trembling_before_the_way_in_has_begun_is_no_way_back() -> None:
    quiet, springing = (slid(back, 0.0, force=1.0).tracks[:, 0, 0] for back in (0.0, -3000.0))
    assert np.abs(springing - quiet).max() < 0.6 * quiet.max()


def test_a_contact_that_slides_pushes_and_never_pulls() -> None:
    run = slid(0.0, 4000.0)
    speed = np.gradient(run.tracks[:, 0, 0], STEP)
    acceleration = np.gradient(speed, STEP)[250:]
    assert acceleration.min() < -20  # it was met
    assert acceleration.max() < 1e-6
    total = run.kinetic + run.stored.sum(axis=1) + run.dissipated.sum(axis=1)
    assert np.ptp(total[250:]) < 0.01 * run.kinetic.max()


def test_a_way_back_that_begins_early_ends_as_the_recorded_one_in_law_and_run() -> None:
    inwards = np.array([[0.0, 0.0, 0.0], [0.005, 0.01, 3000.0], [0.01, 0.02, 500.0]])
    returning = np.array([[0.0, 0.0, -500.0], [0.7, 0.0, -500.0], [1.0, 0.0, 0.0]])
    law = SheetLaw(*inwards.T, *returning.T, stiffness=1e-6, damping=0.0)
    assembly = Assembly()
    body = assembly.add_body("mass", 2.0, 0.0, (0.0, 0.0, 0.0), guided=True)
    time = np.array([0.0, 1e-9, 0.003, 0.003 + 1e-9, 1.0])
    values = np.column_stack([[0.0, 4000.0, 4000.0, -4000.0, -4000.0], np.zeros(5)])
    start, points = add_tables(assembly, time, values)
    assembly.add(RecordedContact(group=body, start=start, points=points, on_leg=0, thickness=0.0))
    path = add_path(assembly, (inwards[:, 0], inwards[:, 1:]), (returning[:, 0], returning[:, 1:]))
    rests = {"first_rest": 0.0, "second_rest": 0.0}
    row = assembly.add(SheetLink(first=body, second=GROUND, **rests, stiffness=1e-6, damping=0.0, **path))
    world = assembly.finish()
    probe = world.place(SheetLink, row, "force")
    run = run_world(world, Plan(STEP, 0.014, 0.0), [probe], tracked=[body])
    progress = 0.5 * run.tracks[:, 0, 0]
    turn = int(np.argmax(progress))
    assert 0.004 < progress[turn] < 0.008  # before the path's end
    assert np.abs(run.readings[1:, 0] - law.force_along(progress)[1:]).max() < 40
    assert run.readings[turn, 0] > 1500
    assert abs(run.readings[progress > 0][-1, 0]) < 40


def test_a_sheet_law_repeats_a_force_that_is_no_function_of_the_shortening() -> None:
    time = np.linspace(0.0, 0.04, 801)
    first = 0.08 * np.sin(np.pi * time / 0.04)
    second = first - 0.005 * np.sin(4 * np.pi * time / 0.04)
    force = 900.0 * np.sin(np.pi * time / 0.04) ** 3
    law = sheet_law(first, second, force, (0.1, 0.1))
    assert law is not None
    assert law.misfit < 3
    shortening = first - second
    meets = [force[np.abs(shortening - x).argsort()[:8]] for x in (-0.002, 0.002)]
    assert all(np.ptp(forces) > 300 for forces in meets)  # one shortening, many forces


def struck(shift: float, *behind: float, share: float = 0.0) -> Trajectory:
    """Throw an upright body with flesh at a face on a mass; its outline shifts as it is pushed in.

    Further strips of the same height may stand behind the first, m; another mass may share the load.
    """
    assembly = Assembly()
    leg = assembly.add_body("leg", 5.0, 0.1, (0.0, 0.0, 0.0), speed=(5.0, 0.0, 0.0))
    face = assembly.add_body("face", 1.0, 0.0, (0.0, 0.0, 0.0), guided=True)
    other = assembly.add_body("other", 2.0, 0.0, (0.0, 0.0, 0.0), guided=True)
    assembly.add_outline(OutlinePiece(body=leg, top=0.2, bottom=-0.2, face=0.0, width=0.05))
    for number, back in enumerate((0.0, *behind)):
        places = np.array([[0.031 + back, 0.0, 0.05], [0.031 + back + shift, 0.0, 0.05]])
        assembly.add(
            FoldingFaceContact(
                group=face,
                partner=other,
                share=share,
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
                **add_path(assembly, (np.array([0.0, 0.02]), places), (np.array([1.0]), np.zeros((1, 3)))),
            )
        )
    return run_world(assembly.finish(), Plan(STEP, 0.02, 0.0), tracked=[leg, face, other])


@pytest.mark.parametrize("shift", [0.0, 0.01])
def test_a_folding_face_takes_the_momentum_that_the_leg_loses(shift: float) -> None:
    run = struck(shift)
    leg, face = (np.gradient(run.tracks[:, k, 0], STEP)[-10] for k in (0, 1))
    assert 5.0 * leg + 1.0 * face == pytest.approx(25.0, rel=1e-3)
    assert face > 5.0


@pytest.mark.parametrize("shift", [0.0, 0.01])
def test_what_a_face_gives_way_by_its_own_folding_is_counted(shift: float) -> None:
    run = struck(shift)
    total = run.kinetic + run.stored.sum(axis=1) + run.dissipated.sum(axis=1)
    assert np.abs(total - total[0]).max() < 0.005 * total[0]
    assert (run.dissipated[-1].sum() > 0.5) == (shift > 0)


def test_a_load_on_the_edge_of_two_groups_is_on_both_and_its_work_is_counted() -> None:
    run = struck(0.0, share=0.4)
    leg, face, other = (np.gradient(run.tracks[:, k, 0], STEP)[-10] for k in range(3))
    assert 5.0 * leg + face + 2.0 * other == pytest.approx(25.0, rel=1e-3)
    assert 2.0 * other == pytest.approx(0.4 / 0.6 * face, rel=1e-3)
    total = run.kinetic + run.stored.sum(axis=1) + run.dissipated.sum(axis=1)
    assert np.abs(total - total[0]).max() < 0.005 * total[0]
    assert run.dissipated[-1].sum() > 0.5


def test_a_strip_behind_another_is_not_met() -> None:
    alone, flanged = struck(0.01), struck(0.01, 0.002)
    assert np.array_equal(alone.tracks, flanged.tracks)
