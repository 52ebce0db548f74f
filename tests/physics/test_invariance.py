"""Nature has no preferred place, direction, hand or unit: neither has the solver."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from msgspec.structs import replace

from certkit.definitions.loading.library import load
from certkit.mechanics.force_laws.condyle_contact import CondyleContact
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.force_laws.ligament_cable import LigamentCable
from certkit.mechanics.legform.leg import add_leg
from certkit.mechanics.legform.segments import leg_segments
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import Assembly, World

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform

STEP = 2e-5


@pytest.fixture(scope="module")
def legform() -> Legform:
    return load("legform", "flex-pli-gtr").document


def flying_leg(legform: Legform) -> tuple[World, list[int]]:
    """Return a whole leg with flesh, hit so that knee and bones bend, and what to read from it."""
    assembly = Assembly()
    leg = add_leg(assembly, legform, leg_segments(legform), flesh=True)
    world = assembly.finish()
    speed = world.speed.copy()
    speed[:, 0] = 4.0 * np.cos(world.pose[:, 1] / 0.15)
    world = replace(world, speed=speed)
    probes = [world.place(JointSpring, joint.row, "moment") for joint in leg.joints]
    probes += [world.place(LigamentCable, row, "elongation") for row in leg.ligaments.values()]
    return world, probes


def readings(world: World, probes: list[int]) -> np.ndarray:
    return run_world(world, Plan(STEP, 0.02, 0.02), probes).readings


def turned(world: World, angle: float, x: float, z: float) -> World:
    """Return the same world elsewhere, turned about the origin."""
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    pose, speed = world.pose.copy(), world.speed.copy()
    pose[:, :2] = pose[:, :2] @ turn.T + [x, z]
    pose[:, 2] += angle
    speed[:, :2] = speed[:, :2] @ turn.T
    return replace(world, pose=pose, speed=speed)


def mirrored(world: World) -> World:
    """Return the world in a mirror on the leg's axis: x, angles and rates of turning change sign."""
    pose, speed, pivots = world.pose.copy(), world.speed.copy(), world.pivots.copy()
    pose[:, [0, 2]] *= -1
    speed[:, [0, 2]] *= -1
    for name in ("first_x", "second_x"):
        pivots[name] *= -1
    mirror = replace(world, pose=pose, speed=speed, pivots=pivots, tables=world.tables.copy())
    for name in ("upper_x", "lower_x"):
        mirror.table(LigamentCable)[name] *= -1
    for name in ("condyle_x", "trough_x", "slip_spring"):
        mirror.table(CondyleContact)[name] *= -1
    return mirror


@pytest.mark.parametrize(("angle", "x", "z"), [(0.0, 12.5, -3.25), (1.1, 0.0, 0.0), (-2.4, 3.0, 40.0)])
def test_a_leg_elsewhere_and_turned_reads_the_same(legform: Legform, angle: float, x: float, z: float):
    world, probes = flying_leg(legform)
    here, there = readings(world, probes), readings(turned(world, angle, x, z), probes)
    scale = np.abs(here).max(axis=0)
    assert np.all(scale > 0)
    assert np.all(np.abs(there - here).max(axis=0) < 1e-6 * scale)


def test_a_leg_in_the_mirror_reads_moments_of_the_other_sign_and_the_same_elongations(legform: Legform):
    world, probes = flying_leg(legform)
    here, there = readings(world, probes), readings(mirrored(world), probes)
    cables = len(legform.knee.ligaments)
    sign = np.ones(len(probes))
    sign[:-cables] = -1
    assert np.all(np.abs(there * sign - here).max(axis=0) < 1e-6 * np.abs(here).max(axis=0))


def test_momentum_and_spin_of_a_flying_leg_do_not_change(legform: Legform):
    world, _ = flying_leg(legform)
    run = run_world(world, Plan(STEP, 0.02, 0.02, frame=1))
    steps = np.diff(run.frames, axis=0) / STEP
    middles = (run.frames[1:] + run.frames[:-1]) / 2
    momentum = np.einsum("i,tic->tc", world.mass, steps[:, :, :2])
    spin = (
        np.einsum(
            "i,ti->t", world.mass, middles[:, :, 0] * steps[:, :, 1] - middles[:, :, 1] * steps[:, :, 0]
        )
        + steps[:, :, 2] @ world.inertia
    )
    scale = np.abs(world.mass * world.speed[:, 0]).sum()
    assert np.abs(momentum - momentum[0]).max() < 1e-9 * scale
    assert np.abs(spin - spin[0]).max() < 1e-4 * scale
