"""The compiled loop does what a plain loop over pymunk's public API does, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest
from numba import njit
from pymunk import batch

from certkit.definitions.loading.library import load
from certkit.errors import RunError
from certkit.mechanics.force_laws import BENDING, BOOKS, CUSHION
from certkit.mechanics.force_laws.law import FORCE, LEDGER, POWER, STORED, Scene
from certkit.mechanics.simulate import build
from certkit.mechanics.solver.kernel import act, predict, tables_of, weigh
from certkit.mechanics.solver.pymunk_space import GET, SET, SPARE, build_space
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import GROUND, Assembly, World


@njit(error_model="numpy")
def forces(layout, index, number, state, mass, drag, gravity, scene, load_, ledger):  # noqa: ANN001, PLR0917  # compiled
    """Evaluate all laws once, for a caller in Python."""
    weigh(mass, drag, gravity, scene, load_, ledger)
    act(tables_of(layout, index, number, state), scene, load_, ledger)


@njit(error_model="numpy")
def foresee(given, share, length, pose, rate, move):  # noqa: ANN001  # compiled
    """Predict, for a caller in Python."""
    return predict(given, share, length, pose, rate, move)


def by_public_api(world: World, step: float, steps: int) -> np.ndarray:
    """Return all poses after each step, shape (steps, bodies, 3)."""
    n = len(world.names)
    space = build_space(world, step)
    state = world.state.copy()
    pose, rate, move, load_ = (np.zeros((n + 1, k)) for k in (5, 3, 3, 3))
    pose[n, 3] = 1.0
    ledger = np.zeros((len(BOOKS), LEDGER))
    read, write, memory = batch.Buffer(), batch.Buffer(), np.zeros(3 * (n + SPARE))
    write.set_float_buf(memory)
    poses = []
    for k in range(steps):
        read.clear()
        batch.get_space_bodies(space, GET, read)
        given = np.frombuffer(read.float_buf()).copy()
        length = step / 2 if k == 0 else step
        assert foresee(given, (0.0, 1.0)[k] if k < 2 else 0.5, length, pose, rate, move)
        ledger[:, [STORED, POWER, FORCE]] = 0.0
        scene = Scene(pose, rate, move, world.outline_body, world.outline, k * step, length, world.schedule)
        forces(
            world.layout,
            world.index,
            world.number,
            state,
            world.mass,
            world.drag,
            world.gravity,
            scene,
            load_,
            ledger,
        )
        load_[:n, 1] *= 1.0 - world.guided
        memory[: 3 * n] = load_[:n].ravel()
        batch.set_space_bodies(space, SET, write)
        space.step(length)
        poses.append(pose[:n, :3].copy())
    return np.array(poses)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["pendulum", "inverse"])
def test_compiled_and_public_loop_agree_bit_for_bit(name: str):
    site = build(load("procedure", name).document, load("legform", "flex-pli-gtr").document)
    world = site.assembly.finish()
    steps = 1000
    ours = run_world(world, Plan(2e-5, (steps - 1) * 2e-5, 0.0, frame=1)).frames
    theirs = by_public_api(world, 2e-5, steps)
    assert np.array_equal(ours[:steps], theirs)


def test_two_runs_are_the_same_bit_for_bit():
    site = build(load("procedure", "inverse").document, load("legform", "flex-pli-gtr").document)
    world = site.assembly.finish()
    one, two = (run_world(world, Plan(2e-5, 0.01, 0.0, frame=1)).frames for _ in range(2))
    assert np.array_equal(one, two)


def test_a_run_that_runs_away_says_when_and_what_to_try():
    assembly = Assembly()
    for i in range(2):
        assembly.add_body(f"link {i}", 0.1, 1e-5, (0.0, -0.04 * i, 0.01 * i))
    assembly.add_pivot(0, 1, 0.0, -0.02)
    assembly.add_row(
        BENDING, (0, 1), {"stiffness": 1e7, "damping": 0.0, "cable angle": 9.0, "cable stiffness": 0.0}
    )
    with pytest.raises(RunError, match=r"ran away after .* ms.*time step of 1e-05 s; try half"):
        run_world(assembly.finish(), Plan(1e-5, 0.1, 0.1))


def test_an_obstacle_that_is_never_touched_is_an_error():
    assembly = Assembly()
    assembly.add_body("leg", 1.0, 0.1, (0.0, 0.0, 0.0))
    with pytest.raises(RunError, match=r"nothing was touched within 0\.01 s"):
        run_world(assembly.finish(), Plan(1e-4, 0.1, 0.01, trigger=CUSHION))


def test_a_hinge_carries_the_weight_that_hangs_on_it():
    assembly = Assembly(gravity=(0.0, -9.81))
    body = assembly.add_body("bob", 3.0, 0.1, (0.0, -0.4, 0.0))
    assembly.hinge = assembly.add_pivot(body, GROUND, 0.0, 0.0)
    run = run_world(assembly.finish(), Plan(1e-4, 0.05, 0.0))
    assert run.hinge_force[10:] == pytest.approx(3.0 * 9.81, rel=1e-6)
