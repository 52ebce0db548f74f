"""A spring whose file has it unload softer than it loads stores no more than was put into it."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.mechanics.force_laws.vehicle_spring import VehicleSpring
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import GROUND, Assembly


@pytest.mark.parametrize(
    "points",
    [[(0.0, 0.0), (0.05, 9000.0)], [(0.0, 0.0), (0.004, 100.0), (0.05, 9000.0)]],
    ids=["straight", "stiffening"],
)
def test_what_is_stored_is_no_more_than_the_blow_brought(points: list[tuple[float, float]]) -> None:
    """Of 9 J the triangle under an unloading of 1 N/mm made 1.6 kJ, beside which no imbalance shows."""
    assembly = Assembly()
    body = assembly.add_body("mass", 2.0, 0.0, (0.0, 0.0, 0.0), speed=(3.0, 0.0, 0.0), guided=True)
    start, count = assembly.add_curve(points)
    row = VehicleSpring(
        first=body,
        second=GROUND,
        rest=0.0,
        push_start=start,
        push_points=count,
        pull_start=0,
        pull_points=0,
        unloading=1e3,
        residual=0.0,
        permanent_set=0.0,
        damping=0.0,
    )
    assembly.add(row)
    run = run_world(assembly.finish(), Plan(step=1e-5, until=0.03, longest=0.03), [], [body])
    stored, dissipated = run.stored.sum(axis=1), run.dissipated.sum(axis=1)
    assert stored.max() == pytest.approx(9.0, rel=1e-3)
    # The branch is cut off by the curve itself: it comes back as it went, and nothing is lost.
    assert run.kinetic[-1] == pytest.approx(9.0, rel=1e-3)
    assert np.abs(dissipated).max() < 0.01
    assert np.abs(run.kinetic + stored + dissipated - 9.0).max() < 0.01
