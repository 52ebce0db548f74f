"""The compiled loop does what a plain loop over pymunk's public API does, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest
from numba import njit
from pymunk import batch

from certkit.definitions.fixtures.rig_builder import GROUND
from certkit.definitions.loading.library import load
from certkit.errors import RunError
from certkit.mechanics.force_laws import ENERGY_ACCOUNTS
from certkit.mechanics.force_laws.flesh_compression import FleshCompression
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.force_laws.law import Instant, Load, Pose, Totals, Velocity
from certkit.mechanics.records import blank, record_type
from certkit.mechanics.simulate import build
from certkit.mechanics.solver.kernel import add_weight_and_damping, evaluate_laws, predict
from certkit.mechanics.solver.kernel_arguments import BodyMotion
from certkit.mechanics.solver.pymunk_space import GET, SET, SPARE, build_space
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import Assembly, World


@njit(error_model="numpy")
def forces(layout, tables, mass, damping, gravity, now, load_, totals):  # noqa: ANN001, PLR0917  # compiled
    """Evaluate all laws once, for a caller in Python."""
    add_weight_and_damping(mass, damping, gravity, now, load_, totals)
    evaluate_laws(layout, tables, now, load_, totals)


@njit(error_model="numpy")
def predicted(motion, share, length, pose, velocity, step_velocity):  # noqa: ANN001  # compiled
    """Predict, for a caller in Python."""
    return predict(motion, share, length, pose, velocity, step_velocity)


def by_public_api(world: World, step: float, steps: int) -> np.ndarray:
    """Return all poses after each step, shape (steps, bodies, 3)."""
    n = len(world.names)
    space = build_space(world, step)
    tables = world.tables.copy()
    pose, load_ = blank(Pose, n + 1), blank(Load, n + 1)
    velocity, step_velocity = blank(Velocity, n + 1), blank(Velocity, n + 1)
    pose["cos"][n] = 1.0
    totals = blank(Totals, len(ENERGY_ACCOUNTS))
    read, write, memory = batch.Buffer(), batch.Buffer(), np.zeros(3 * (n + SPARE))
    write.set_float_buf(memory)
    poses = []
    for k in range(steps):
        read.clear()
        batch.get_space_bodies(space, GET, read)
        motion = np.frombuffer(read.float_buf()).copy().view(record_type(BodyMotion))
        length = step / 2 if k == 0 else step
        share = (0.0, 1.0)[k] if k < 2 else 0.5
        assert predicted(motion, share, length, pose, velocity, step_velocity)
        now = Instant(pose, velocity, step_velocity, world.outline, world.curves, k * step, length)
        forces(world.layout, tables, world.mass, world.damping, world.gravity, now, load_, totals)
        load_["z"][:n] *= 1.0 - world.guided
        memory[: 3 * n] = load_[:n].view(np.float64)
        batch.set_space_bodies(space, SET, write)
        space.step(length)
        poses.append(pose[:n].view(np.float64).reshape(n, -1)[:, :3].copy())
    return np.array(poses)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["pendulum", "inverse"])
def test_compiled_and_public_loop_agree_bit_for_bit(name: str):
    rig = build(load("procedure", name).document, load("legform", "flex-pli-gtr").document)
    world = rig.assembly.finish()
    steps = 1000
    ours = run_world(world, Plan(2e-5, (steps - 1) * 2e-5, 0.0, frame=1)).frames
    theirs = by_public_api(world, 2e-5, steps)
    assert np.array_equal(ours[:steps], theirs)


def test_two_runs_are_the_same_bit_for_bit():
    rig = build(load("procedure", "inverse").document, load("legform", "flex-pli-gtr").document)
    world = rig.assembly.finish()
    one, two = (run_world(world, Plan(2e-5, 0.01, 0.0, frame=1)).frames for _ in range(2))
    assert np.array_equal(one, two)


def test_a_run_that_runs_away_says_when_and_what_to_try():
    assembly = Assembly()
    for i in range(2):
        assembly.add_body(f"link {i}", 0.1, 1e-5, (0.0, -0.04 * i, 0.01 * i))
    assembly.add_pivot(0, 1, 0.0, -0.02)
    assembly.add(
        JointSpring(upper=0, lower=1, stiffness=1e7, damping=0.0, cable_angle=9.0, cable_stiffness=0.0)
    )
    with pytest.raises(RunError, match=r"ran away after .* ms.*time step of 1e-05 s; try half"):
        run_world(assembly.finish(), Plan(1e-5, 0.1, 0.1))


def test_an_obstacle_that_is_never_touched_is_an_error():
    assembly = Assembly()
    assembly.add_body("leg", 1.0, 0.1, (0.0, 0.0, 0.0))
    with pytest.raises(RunError, match=r"nothing was touched within 0\.01 s"):
        run_world(assembly.finish(), Plan(1e-4, 0.1, 0.01, trigger=FleshCompression))


def test_a_hinge_carries_the_weight_that_hangs_on_it():
    assembly = Assembly(gravity=(0.0, -9.81))
    body = assembly.add_body("bob", 3.0, 0.1, (0.0, -0.4, 0.0))
    assembly.hinge = assembly.add_pivot(body, GROUND, 0.0, 0.0)
    run = run_world(assembly.finish(), Plan(1e-4, 0.05, 0.0))
    assert run.hinge_force[10:] == pytest.approx(3.0 * 9.81, rel=1e-6)
