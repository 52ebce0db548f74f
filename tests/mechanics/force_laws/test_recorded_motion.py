"""A body that is led along a recorded motion."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.mechanics.force_laws.recorded_contact import RecordedContact
from certkit.mechanics.force_laws.recorded_motion import RecordedMotion
from certkit.mechanics.rig.recorded_tables import add_tables
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import Assembly

STEP = 2e-5


@pytest.mark.parametrize("force", [0.0, 1e5])
def test_a_led_body_is_where_its_record_is_whatever_presses_on_it(force: float) -> None:
    time = np.linspace(0.0, 0.02, 2001)
    wanted = np.column_stack([0.05 * np.sin(200 * time), 0.02 * time, 0.3 * np.cos(150 * time) - 0.3])
    assembly = Assembly(gravity=(0.0, -9.81))
    body = assembly.add_body("led", 2.0, 0.01, (0.0, 0.0, 0.0), speed=(10.0, 0.02, 0.0))
    start, points = add_tables(assembly, time, wanted)
    assembly.add(RecordedMotion(body=body, start=start, points=points, mass=2.0, inertia=0.01))
    pressed, count = add_tables(assembly, np.array([0.0, 1.0]), np.array([[force, 0.0], [force, 0.0]]))
    assembly.add(RecordedContact(group=body, start=pressed, points=count, on_leg=0, thickness=0.0))
    run = run_world(assembly.finish(), Plan(STEP, 0.02, 0.0), tracked=[body])
    for k in range(3):
        assert run.tracks[:, 0, k] == pytest.approx(np.interp(run.time, time, wanted[:, k]), abs=1e-6)
