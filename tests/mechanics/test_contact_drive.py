"""Leg and front led along a motion: what the contact law alone makes of it."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from scipy.interpolate import CubicSpline

from certkit.bench.setup import Setup, prepare
from certkit.mechanics import Simulation, simulate
from certkit.mechanics.contact_drive import LedMotion, drive_contact
from certkit.mechanics.outputs.front_response import contact_by_group

INSIDE = 1e-3
"""m: the points of a segment's axis stand so far within its ends."""


@pytest.fixture(scope="module")
def setup() -> Setup:
    return prepare("vehicle-fe-front")


@pytest.fixture(scope="module")
def done(setup: Setup) -> Simulation:
    return simulate(setup.procedure, setup.legform, vehicle=setup.vehicle)


def motion_of(done: Simulation) -> LedMotion:
    """Return the motion of a run as histories would tell it: two points on the axis of each segment."""
    rig, run = done.rig, done.run
    assert rig.front is not None
    seen, rows = run.frame_time, []
    for segment, body, centre in zip(rig.leg.segments, rig.leg.bodies, rig.leg.centres, strict=True):
        x, z, angle = run.frames[:, body].T
        below = 0.0 if segment.bottom == rig.leg.bottom else INSIDE
        rows += [
            np.column_stack([x - height * np.sin(angle), z + height * np.cos(angle)])
            for height in (segment.top - INSIDE - centre, segment.bottom + below - centre)
        ]
    time = np.arange(0.0, min(seen[-1], 0.045), 2e-4)
    offset = run.tracks.shape[1] - len(rig.front.groups)
    return LedMotion(
        time=time,
        contact=0.0,
        axis=CubicSpline(seen, np.array(rows[::-1]), axis=1)(time),
        groups={
            name: np.interp(time, run.time, run.tracks[:, offset + k, 0] - run.tracks[0, offset + k, 0])
            for k, name in enumerate(rig.front.groups)
        },
    )


def test_a_contact_led_along_a_runs_own_motion_gives_that_runs_forces(setup: Setup, done: Simulation) -> None:
    assert setup.vehicle is not None
    time, forces = drive_contact(setup.procedure, setup.legform, setup.vehicle, motion_of(done))
    wanted = {name: f for name, f in contact_by_group(done.rig, done.readings).items() if f.max() > 0}
    assert {name for name, force in forces.items() if force.max() > 0} == wanted.keys()
    for name, force in wanted.items():
        there = np.interp(time, done.run.time, force)
        assert np.sqrt(np.mean((forces[name] - there) ** 2)) < 0.05 * force.max(), name
        assert np.trapezoid(forces[name], time) == pytest.approx(np.trapezoid(there, time), abs=1.0)


def test_a_leg_that_is_led_farther_back_is_pressed_on_less(setup: Setup, done: Simulation) -> None:
    assert setup.vehicle is not None
    led = motion_of(done)
    back = led.axis - np.array([0.004, 0.0]) * np.minimum(led.time / 0.005, 1.0)[:, None]
    impulses = []
    for motion in (led, replace(led, axis=back)):
        time, forces = drive_contact(setup.procedure, setup.legform, setup.vehicle, motion)
        impulses.append(sum(np.trapezoid(force, time) for force in forces.values()))
    assert 0 < impulses[1] < 0.9 * impulses[0]
