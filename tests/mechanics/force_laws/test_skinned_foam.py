"""What a skinned foam does: it takes its surroundings along, and gives back what its memory leaves."""

from __future__ import annotations

import math

import numpy as np
import pytest

from certkit.definitions.fixtures.rig_builder import GROUND
from certkit.mechanics.force_laws import LAWS
from certkit.mechanics.force_laws.law import OutlinePiece
from certkit.mechanics.force_laws.recorded_contact import RecordedContact
from certkit.mechanics.force_laws.skinned_foam_contact import SkinnedFoamContact
from certkit.mechanics.rig.recorded_tables import add_path, add_tables
from certkit.mechanics.solver.time_loop import Plan, Trajectory, run_world
from certkit.mechanics.solver.world import Assembly

STEP = 1e-5
STILL = (np.array([1.0]), np.zeros((1, 3)))
FOUNDATION = 2e6
"""k, N/m²."""


PLAIN = {
    "hysteresis": 1.0,
    "shape": 1.0,
    "loss": 0.0,
    "reversal": 1.0,
    "recovery": 0.0,
    "shear": 0.0,
    "skin": 0.0,
}
"""Foam that gives back what it took, without a skin."""


def add_strip(
    assembly: Assembly,
    face: int,
    curve: tuple[int, int],
    place: tuple[float, float, float],
    order: int = 0,
    **foam: float,
) -> None:
    """Let a strip of a face meet 30 mm of foam: x, height and size, m."""
    assembly.add(
        SkinnedFoamContact(
            lower=face,
            upper=face,
            share=0.0,
            load_share=0.0,
            rest=0.0,
            foam_start=curve[0],
            foam_points=curve[1],
            layer=0.03,
            thickness=0.03,
            friction=0.0,
            order=order,
            **PLAIN | foam,
            **add_path(assembly, (np.zeros(1), np.array([place])), STILL),
        )
    )


def struck(
    faces: list[tuple[float, float, float]],
    *,
    mass: float = 5.0,
    speed: float = 5.0,
    spin: float = 0.0,
    free: float = 0.0,
    until: float = 0.02,
    curve: tuple[tuple[float, float], ...] = ((0.0, 0.0), (0.01, 1e-2 * FOUNDATION)),
    **foam: float,
) -> Trajectory:
    """Throw an upright body with 30 mm of foam at strips: place in front of the foam, height, size, m.

    They are held, or on a mass of `free` (kg). Recorded are force and pressed depth of every strip.
    """
    assembly = Assembly()
    leg = assembly.add_body("leg", mass, 0.1, (0.0, 0.0, 0.0), speed=(speed, 0.0, spin))
    assembly.add_outline(OutlinePiece(body=leg, top=0.2, bottom=-0.2, face=0.0, width=0.09))
    bodies = [leg]
    if free:
        bodies.append(assembly.add_body("face", free, 0.0, (0.0, 0.0, 0.0), guided=True))
    law = assembly.add_curve(list(curve))
    for number, (gap, z, height) in enumerate(faces):
        place = (0.03 + gap, z, height)
        add_strip(assembly, bodies[-1] if free else GROUND, law, place, number, **foam)
    world = assembly.finish()
    rows = range(len(faces))
    probes = [world.place(SkinnedFoamContact, row, state) for state in ("force", "pressed") for row in rows]
    return run_world(world, Plan(STEP, until, 0.0), probes=probes, tracked=bodies)


def row(height: float, half: float = 0.15, *, crest: float = 0.0) -> list[tuple[float, float, float]]:
    """Return strips from z = half down to -half, the middle one further in front by `crest`."""
    count = round(2 * half / height) | 1
    middles = [half - (k + 0.5) * 2 * half / count for k in range(count)]
    return [(0.05 if crest and k != count // 2 else 0.0, z, 2 * half / count) for k, z in enumerate(middles)]


def test_a_crest_presses_its_surroundings_as_the_closed_form_says() -> None:
    shear = 800.0
    strips = row(0.002, crest=1.0)
    run = struck(strips, mass=1e6, speed=0.1, until=0.01, shear=shear)
    half = run.readings.shape[1] // 2
    force, pressed = run.readings[-1, :half], run.readings[-1, half:]
    depth = run.tracks[-1, 0, 0]
    length = math.sqrt(shear / FOUNDATION)
    z = np.array([strip[1] for strip in strips])
    assert pressed == pytest.approx(depth * np.exp(-np.abs(z) / length), abs=0.01 * depth)
    assert force.sum() == pytest.approx(2 * math.sqrt(shear * FOUNDATION) * depth, rel=0.01)
    assert np.count_nonzero(force) == 1


def test_without_shear_and_skin_every_strip_is_alone() -> None:
    run = struck(row(0.006, crest=1.0), mass=1e6, speed=0.1, until=0.01)
    depth = run.tracks[-1, 0, 0]
    half = run.readings.shape[1] // 2
    assert run.readings[-1, :half].sum() == pytest.approx(FOUNDATION * depth * 0.3 / 51, rel=1e-6)
    assert np.count_nonzero(run.readings[-1, half:] > 1e-9) == 1


def test_a_skin_stiffens_with_its_slope() -> None:
    forces = [
        struck(row(0.006, crest=1.0), mass=1e6, speed=speed, until=0.01, skin=2700.0).readings[-1, :51].sum()
        for speed in (0.5, 1.0)
    ]
    assert forces[1] > 2.2 * forces[0]


def test_an_even_face_feels_no_shear() -> None:
    bare = struck(row(0.006))
    skinned = struck(row(0.006), shear=800.0, skin=2700.0)
    assert skinned.tracks[:, 0, 0] == pytest.approx(bare.tracks[:, 0, 0], abs=1e-9)


@pytest.mark.parametrize("free", [0.0, 1.5])
def test_momentum_and_energy_balance(free: float) -> None:
    strips = [(0.004 * math.sin(40 * z), z, h) for _, z, h in row(0.006)]
    law = {"hysteresis": 0.35, "shape": 5.0, "shear": 675.0, "skin": 2700.0}
    run = struck(strips, free=free, spin=3.0, until=0.015, **law)
    total = run.kinetic + run.stored.sum(axis=1) + run.dissipated.sum(axis=1)
    assert np.abs(total - total[0]).max() < 0.005 * total[0]
    assert run.dissipated[-1].sum() > 0.1 * total[0]
    if free:
        leg, face = (np.gradient(run.tracks[:, k, 0], STEP)[-10] for k in (0, 1))
        assert 5.0 * leg + free * face == pytest.approx(25.0, rel=1e-3)


def test_half_the_strips_press_alike() -> None:
    law = {"hysteresis": 0.35, "shape": 5.0, "shear": 675.0, "skin": 2700.0, "until": 0.005}
    coarse, fine = (
        struck([(12 * z * z, z, h) for _, z, h in row(height)], **law) for height in (0.006, 0.003)
    )
    forces = [run.readings[:, : run.readings.shape[1] // 2].sum(axis=1) for run in (coarse, fine)]
    assert forces[0] == pytest.approx(forces[1], abs=0.01 * forces[1].max())


def test_what_foam_gives_back_is_the_closed_form_of_its_memory() -> None:
    hysteresis, shape = 0.35, 5.0
    run = struck(row(0.006), hysteresis=hysteresis, shape=shape, curve=((0, 0), (3e-3, 2e3), (2e-2, 9e4)))
    speed = np.gradient(run.tracks[:, 0, 0], STEP)
    returned = hysteresis + (1 - hysteresis) / (shape + 1)
    assert (speed[-10] / speed[10]) ** 2 == pytest.approx(returned, rel=0.01)


def test_a_crest_gets_back_the_same_share_since_foam_that_springs_back_is_softer_in_shear_too() -> None:
    hysteresis, shape = 0.35, 5.0
    run = struck(row(0.002, crest=1.0), until=0.04, shear=800.0, hysteresis=hysteresis, shape=shape)
    speed = np.gradient(run.tracks[:, 0, 0], STEP)
    returned = hysteresis + (1 - hysteresis) / (shape + 1)
    assert speed[-10] < 0
    assert (speed[-10] / speed[10]) ** 2 == pytest.approx(returned, rel=0.02)


def test_an_elastic_foam_loses_nothing_while_the_leg_turns() -> None:
    strips = [(0.002 + 0.002 * math.sin(40 * z), z, h) for _, z, h in row(0.006, 0.1)]
    run = struck(strips, spin=6.0, shear=675.0, skin=2700.0, until=0.01)
    assert run.kinetic[-1] < 0.9 * run.kinetic[0]
    assert abs(run.dissipated[-1].sum()) < 1e-3 * run.kinetic[0]


@pytest.mark.parametrize("recovery", [0.0, 1e-4])
def test_foam_that_forgets_loses_in_a_second_blow_what_it_lost_in_the_first(recovery: float) -> None:
    """A mass pushed twice against foam on a heavy leg, pulled back between."""
    assembly = Assembly()
    leg = assembly.add_body("leg", 1e6, 1e6, (0.0, 0.0, 0.0))
    face = assembly.add_body("face", 0.05, 0.0, (0.0, 0.0, 0.0), guided=True, damping=100.0)
    assembly.add_outline(OutlinePiece(body=leg, top=0.2, bottom=-0.2, face=0.0, width=0.09))
    curve = assembly.add_curve([(0.0, 0.0), (0.01, 1e-2 * FOUNDATION)])
    foam = {"hysteresis": 0.3, "shape": 5.0, "recovery": recovery}
    add_strip(assembly, face, curve, (0.03, 0.0, 0.05), **foam)
    time = np.arange(0.0, 0.1, 1e-4)
    force = -300.0 * (1.0 - np.cos(2 * math.pi * time / 0.05))
    where, count = add_tables(assembly, time, np.column_stack([force, np.zeros_like(time)]))
    assembly.add(RecordedContact(group=face, start=where, points=count, on_leg=0, thickness=0.0))
    run = run_world(assembly.finish(), Plan(STEP, 0.1, 0.0), tracked=[leg, face])
    lost = run.dissipated[:, LAWS.index(SkinnedFoamContact)]
    first, both = lost[len(lost) // 2], lost[-1]
    assert first > 0.1
    assert both == pytest.approx((2 if recovery else 1) * first, rel=0.2)
