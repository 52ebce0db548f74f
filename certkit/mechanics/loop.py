"""Run a `World` for a while: the one door between builders and the compiled loop."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import RunError
from certkit.mechanics.kernel import RAN_AWAY, compiled_march
from certkit.mechanics.laws import BOOKS
from certkit.mechanics.laws.table import LEDGER, Floats
from certkit.mechanics.space import ITERATIONS, build_space, open_gateway

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.mechanics.world import World


@dataclass(frozen=True)
class Plan:
    """How long a run takes, and what is kept of it.

    Parameters
    ----------
    step : float
        Time step in seconds.
    until : float
        Seconds after first contact (or after the start, where there is no `trigger`).
    longest : float
        Seconds after the start at which the run ends in any case.
    sample, frame : int
        Steps from one sample, and from one frame of the moving picture, to the next.
    trigger : int
        Law whose force marks first contact; -1: contact is at the start.
    iterations : int
        Of pymunk's constraint solver.
    """

    step: float
    until: float
    longest: float
    sample: int = 1
    frame: int = 50
    trigger: int = -1
    iterations: int = ITERATIONS


@dataclass(frozen=True)
class Trajectory:
    """What a run yields, one row a sample.

    Parameters
    ----------
    time : ndarray, shape (s,)
        Seconds from the start.
    contact : float
        When first contact came.
    readings : ndarray, shape (s, probes)
    tracks, accelerations : ndarray, shape (s, tracked, 3) and (s, tracked, 2)
    stored, spent : ndarray, shape (s, books)
        Energy stored and dissipated by law; see `certkit.mechanics.laws.BOOKS`.
    kinetic, hinge_force, contact_force : ndarray, shape (s,)
    frame_time, frames : ndarray, shape (f,) and (f, bodies, 3)
    joint_gap, penetration : float
        Largest of the run, m.
    steps : int
    seconds : float
        Of the loop alone.
    """

    time: Floats
    contact: float
    readings: Floats
    tracks: Floats
    accelerations: Floats
    stored: Floats
    spent: Floats
    kinetic: Floats
    hinge_force: Floats
    contact_force: Floats
    frame_time: Floats
    frames: Floats
    joint_gap: float
    penetration: float
    steps: int
    seconds: float


def run_world(
    world: World, plan: Plan, probes: Sequence[int] = (), tracked: Sequence[int] = ()
) -> Trajectory:
    """March a world through its plan.

    Parameters
    ----------
    world : World
    plan : Plan
    probes : sequence of int
        Places in the state pool to record (`World.place`).
    tracked : sequence of int
        Bodies whose pose and acceleration are recorded at every sample.

    Raises
    ------
    RunError
        When a body runs away or never touches what it should.
    """
    bodies, laws = len(world.names), len(BOOKS)
    most = round((plan.longest if plan.trigger >= 0 else plan.until) / plan.step)
    after = round(plan.until / plan.step)
    samples, shots = most // plan.sample + 1, most // plan.frame + 1
    readings = np.zeros((samples, len(probes)))
    tracks = np.zeros((samples, len(tracked), 3))
    accelerations = np.zeros((samples, len(tracked), 2))
    books = np.zeros((samples, laws, 2))
    scalars = np.zeros((samples, 3))
    frames = np.zeros((shots, bodies, 3))
    worst = np.zeros(2)
    space = build_space(world, plan.step, plan.iterations)
    gate = open_gateway(space, world)
    started = time.perf_counter()
    status, steps, filled, taken, contact = compiled_march(
        gate.entry,
        gate.counters,
        gate.given,
        gate.taken,
        world.mass,
        world.inertia,
        world.guided,
        world.drag,
        world.gravity,
        world.outline_body,
        world.outline,
        world.layout,
        world.index,
        world.number,
        world.state.copy(),
        world.pivot,
        world.anchor,
        world.schedule,
        plan.step,
        np.array([most, plan.sample, plan.frame, plan.trigger, after], dtype=np.int64),
        np.array(probes, dtype=np.int64),
        np.array(tracked, dtype=np.int64),
        np.zeros((bodies + 1, 5)),
        np.zeros((bodies + 1, 3)),
        np.zeros((bodies + 1, 3)),
        np.zeros((bodies + 1, 3)),
        np.zeros((laws, LEDGER)),
        readings,
        tracks,
        accelerations,
        books,
        scalars,
        frames,
        worst,
    )
    seconds = time.perf_counter() - started
    if status == RAN_AWAY:
        raise RunError(
            f"the simulation ran away after {steps * plan.step * 1e3:.3f} ms: a spring, damper or contact is "
            f"too stiff for a time step of {plan.step:g} s; try half of it, or look at what was changed last"
        )
    if contact < 0:
        raise RunError(
            f"nothing was touched within {plan.longest:g} s; check the release and the place of the obstacle"
        )
    return Trajectory(
        time=np.arange(filled) * (plan.step * plan.sample),
        contact=contact * plan.step,
        readings=readings[:filled],
        tracks=tracks[:filled],
        accelerations=accelerations[:filled],
        stored=books[:filled, :, 0],
        spent=books[:filled, :, 1],
        kinetic=scalars[:filled, 0],
        hinge_force=scalars[:filled, 1],
        contact_force=scalars[:filled, 2],
        frame_time=np.arange(taken) * (plan.step * plan.frame),
        frames=frames[:taken],
        joint_gap=float(worst[0]),
        penetration=float(worst[1]),
        steps=int(steps),
        seconds=seconds,
    )
