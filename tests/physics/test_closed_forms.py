"""What mechanics knows in closed form: falls, swings, bounces, collisions, natural frequencies."""

from __future__ import annotations

import math

import numpy as np
import pytest
from msgspec.structs import replace
from scipy.linalg import eigh
from support.chain_oracle import Chain, bone_chain

from certkit.definitions.fixtures.rig_builder import GROUND
from certkit.mechanics.force_laws.honeycomb import Honeycomb
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.force_laws.law import OutlinePiece
from certkit.mechanics.force_laws.support_roller import SupportRoller
from certkit.mechanics.solver.time_loop import Plan, Trajectory, run_world
from certkit.mechanics.solver.world import Assembly


def energy(run: Trajectory) -> np.ndarray:
    return run.kinetic + run.stored.sum(axis=1) + run.dissipated.sum(axis=1)


def test_a_thrown_body_follows_its_parabola_exactly():
    assembly = Assembly(gravity=(0.0, -9.81))
    assembly.add_body("stone", 2.0, 0.1, (1.0, 2.0, 0.3), speed=(3.0, 4.0, 5.0))
    run = run_world(assembly.finish(), Plan(1e-4, 0.5, 0.5), tracked=[0])
    t = run.time
    path = np.stack([1 + 3 * t, 2 + 4 * t - 9.81 / 2 * t**2, 0.3 + 5 * t], axis=1)
    assert np.allclose(run.tracks[:, 0], path, rtol=0, atol=1e-11)


def test_a_guided_body_keeps_to_its_line():
    assembly = Assembly(gravity=(1.0, -9.81))
    assembly.add_body("ram", 2.0, 0.0, (0.0, 0.5, 0.0), speed=(3.0, 0.0, 0.0), guided=True)
    run = run_world(assembly.finish(), Plan(1e-4, 0.1, 0.1), tracked=[0])
    assert np.all(run.tracks[:, 0, 1:] == [0.5, 0.0])
    assert run.tracks[-1, 0, 0] == pytest.approx(3 * 0.1 + 0.5 * 0.1**2, rel=1e-9)


@pytest.mark.parametrize("amplitude", [0.05, 1.5])
def test_a_pendulum_has_its_period(amplitude: float):
    mass, inertia, arm = 3.0, 0.02, 0.4
    assembly = Assembly(gravity=(0.0, -9.81))
    body = assembly.add_body("bob", mass, inertia, (0.0, -arm, 0.0))
    assembly.add_pivot(body, GROUND, 0.0, 0.0)
    assembly.turn(amplitude, 0.0, 0.0)
    run = run_world(assembly.finish(), Plan(1e-4, 4.0, 4.0), tracked=[body])
    angle = run.tracks[:, 0, 2]
    falling = np.flatnonzero((angle[:-1] > 0) & (angle[1:] <= 0))
    crossings = run.time[falling] + 1e-4 * angle[falling] / (angle[falling] - angle[falling + 1])
    # The period at any amplitude, by the arithmetic-geometric mean.
    a, b = 1.0, math.cos(amplitude / 2)
    for _ in range(20):
        a, b = (a + b) / 2, math.sqrt(a * b)
    period = 2 * math.pi * math.sqrt((inertia + mass * arm**2) / (mass * 9.81 * arm)) / a
    assert np.diff(crossings).mean() == pytest.approx(period, rel=1e-5)


def test_a_mass_bounces_off_a_one_sided_spring_as_theory_says():
    mass, stiffness, speed, step = 4.0, 2e6, 3.0, 1e-5
    assembly = Assembly()
    body = assembly.add_body("mass", mass, 0.01, (0.001, 0.0, 0.0), speed=(-speed, 0.0, 0.0))
    assembly.add_outline(OutlinePiece(body, 0.2, -0.2, 0.0, 0.0))
    for z in (0.1, -0.1):
        assembly.add(SupportRoller(station=z, stiffness=stiffness / 2))
    world = assembly.finish()
    forces = [world.place(SupportRoller, i, "force") for i in range(2)]
    run = run_world(world, Plan(step, 0.01, 0.01), forces, [body])
    omega = math.sqrt(stiffness / mass)
    assert run.readings.sum(axis=1).max() == pytest.approx(stiffness * speed / omega, rel=1e-5)
    assert (run.readings[:, 0] > 0).sum() * step == pytest.approx(math.pi / omega, abs=2 * step)
    back = (run.tracks[-1, 0, 0] - run.tracks[-101, 0, 0]) / (100 * step)
    assert back == pytest.approx(speed, rel=1e-5)


def test_a_ram_that_crushes_honeycomb_against_a_free_bar_keeps_momentum_and_energy():
    ram_mass, bar_mass, speed = 8.0, 4.0, 11.0
    assembly = Assembly()
    bar = assembly.add_body("bar", bar_mass, bar_mass * 0.4**2 / 12, (0.0, 0.0, 0.0))
    assembly.add_outline(OutlinePiece(bar, 0.2, -0.2, 0.0, 0.05))
    ram = assembly.add_body("ram", ram_mass, 0.0, (0.0, 0.0, 0.0), speed=(-speed, 0.0, 0.0), guided=True)
    for i in range(20):
        assembly.add(
            Honeycomb(
                carrier=ram,
                face_x=0.0,
                face_z=0.038 - 0.004 * i,
                height=0.004,
                strength=5e5,
                elastic_depth=1e-3,
                thickness=0.0,
            )
        )
    run = run_world(assembly.finish(), Plan(1e-5, 0.03, 0.03), tracked=[bar, ram])
    speeds = np.diff(run.tracks[:, :, 0], axis=0) / 1e-5
    momentum = speeds @ [bar_mass, ram_mass]
    assert np.allclose(momentum, -ram_mass * speed, rtol=1e-9)
    balance = energy(run)
    assert np.abs(balance - balance[0]).max() < 1e-3 * balance[0]
    # Perfectly plastic but for the little that the honeycomb springs back.
    common = -ram_mass * speed / (ram_mass + bar_mass)
    lost = 0.5 * ram_mass * bar_mass / (ram_mass + bar_mass) * speed**2
    sprung = 0.5 * 5e5 * 0.05 * 0.08 * 1e-3
    assert run.dissipated[-1].sum() == pytest.approx(lost - sprung, rel=2e-3)
    assert speeds[-1] @ [bar_mass, ram_mass] / (bar_mass + ram_mass) == pytest.approx(common, rel=1e-9)


def natural_frequencies(chain: Chain, *, clamped: bool) -> np.ndarray:
    """Return those of the undamped chain in Hz, from its mass and stiffness matrices."""
    n = chain.links
    _, jacobian = chain.centres(np.zeros(n + 2))
    mass = np.einsum("i,icj,ick->jk", chain.mass, jacobian, jacobian)
    mass[2:, 2:] += np.diag(chain.inertia)
    stiffness = np.zeros((n + 2, n + 2))
    for i in range(n - 1):
        stiffness[2 + i : 4 + i, 2 + i : 4 + i] += chain.stiffness[i] * np.array([[1, -1], [-1, 1]])
    keep = np.arange(3, n + 2) if clamped else np.r_[0, 2 : n + 2]
    values = eigh(stiffness[np.ix_(keep, keep)], mass[np.ix_(keep, keep)], eigvals_only=True)
    return np.sqrt(np.clip(values, 0, None)) / (2 * math.pi)


def measured_frequency(chain: Chain, shape: np.ndarray, guess: float, *, clamped: bool) -> float:
    """Let the chain swing gently in a shape of angles; return its frequency by zero crossings."""
    n = chain.links
    q = np.zeros(n + 2)
    q[2:] = 1e-4 * shape
    world = chain.world(q, np.zeros(n + 2))
    if clamped:
        heavy = world.mass.copy(), world.inertia.copy()
        heavy[0][0], heavy[1][0] = 1e9, 1e9
        world = replace(world, mass=heavy[0], inertia=heavy[1])
    joint = n // 2 - 1
    run = run_world(world, Plan(2e-5, 6 / guess, 1), [world.place(JointSpring, joint, "angle")])
    angle = run.readings[:, 0]
    falling = np.flatnonzero((angle[:-1] > 0) & (angle[1:] <= 0))
    times = run.time[falling] + 2e-5 * angle[falling] / (angle[falling] - angle[falling + 1])
    return float((len(times) - 1) / (times[-1] - times[0]))


def uniform_chain(links: int) -> tuple[Chain, float, float]:
    """Return a uniform beam cut into thin links, the root of its stiffness over line mass, and its length."""
    length, line_mass, bending_stiffness = 0.72, 7.0, 170.0
    h = length / links
    ones = np.ones(links)
    return (
        Chain(
            length=h * ones,
            arm=h / 2 * ones,
            mass=line_mass * h * ones,
            inertia=line_mass * h**3 / 12 * ones,
            stiffness=bending_stiffness / h * ones[1:],
            damping=0.0 * ones[1:],
        ),
        math.sqrt(bending_stiffness / line_mass),
        length,
    )


@pytest.mark.parametrize(("clamped", "root"), [(False, 4.730040745), (True, 1.875104069)])
def test_the_segmented_beam_swings_at_its_own_and_nearly_at_the_continuous_frequency(
    clamped: bool,  # noqa: FBT001  # a parameter of the test
    root: float,
):
    chain, wave, length = uniform_chain(18)
    # The clamped link is rigid, and the first joint bends for half a link on either side of it.
    free = length - length / chain.links / 2 if clamped else length
    beam = (root / free) ** 2 * wave / (2 * math.pi)
    own = natural_frequencies(chain, clamped=clamped)
    own = own[own > 1.0][0]
    middles = (np.arange(chain.links) + 0.5) / chain.links * length
    k = root / length
    # Slopes of the beam's mode, by Rayleigh's formulas.
    sign = 1 if clamped else -1
    ratio = (math.cosh(root) + sign * math.cos(root)) / (math.sinh(root) + sign * math.sin(root))
    odd = np.sinh(k * middles) + sign * np.sin(k * middles)
    even = np.cosh(k * middles) - sign * np.cos(k * middles)
    shape = odd - ratio * even
    found = measured_frequency(chain, shape / np.abs(shape).max(), beam, clamped=clamped)
    assert found == pytest.approx(own, rel=5e-3)
    assert own == pytest.approx(beam, rel=0.01)


def test_the_chain_of_the_leg_keeps_its_energy_without_damping():
    chain = bone_chain(damping_time=0.0)
    n = chain.links
    v = np.zeros(n + 2)
    v[2:] = 20.0 * np.sin(2 * np.pi * np.arange(n) / (n - 1))
    run = run_world(chain.world(np.zeros(n + 2), v), Plan(2e-5, 0.1, 0.1))
    balance = energy(run)
    assert np.abs(balance - balance[0]).max() < 1e-3 * balance[0]
