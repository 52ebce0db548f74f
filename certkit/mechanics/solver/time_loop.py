"""Run a `World` for a while: the one door between builders and the compiled loop."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import RunError
from certkit.mechanics.force_laws import BOOKS
from certkit.mechanics.force_laws.law import LEDGER, Floats
from certkit.mechanics.solver.kernel_arguments import RAN_AWAY, Handover
from certkit.mechanics.solver.object_cache import loop
from certkit.mechanics.solver.pymunk_space import ITERATIONS, build_space, open_gateway

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.mechanics.solver.world import World


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
        Energy stored and dissipated by law; see `certkit.mechanics.force_laws.BOOKS`.
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


MOST_STEPS, MOST_SAMPLES = 10_000_000, 1_000_000
"""A run beyond them is a slip of the pen, and would fill the memory or the day."""


def _check(plan: Plan) -> None:
    wanted = f"a run of {plan.until:g} s in steps of {plan.step:g} s"
    if not (plan.step > 0 and plan.until > 0):
        raise RunError(f"{wanted} goes nowhere; both must be positive")
    if plan.until < 2 * plan.sample * plan.step:
        raise RunError(f"{wanted} is too short for two samples; give `until` more, or the step less")
    steps = max(plan.until, plan.longest) / plan.step
    if steps > MOST_STEPS or steps / plan.sample > MOST_SAMPLES:
        raise RunError(
            f"{wanted} is too long: {steps:.3g} steps; "
            f"at most {MOST_STEPS:,} are simulated and {MOST_SAMPLES:,} kept"
        )


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
        When a body runs away or never touches what it should, or the plan is no plan.
    """
    bodies, laws = len(world.names), len(BOOKS)
    _check(plan)
    most = round((plan.longest if plan.trigger >= 0 else plan.until) / plan.step)
    after = round(plan.until / plan.step)
    samples, shots = most // plan.sample + 1, most // plan.frame + 1
    space = build_space(world, plan.step, plan.iterations)
    gate = open_gateway(space, world)
    run = Handover(
        entry=gate.entry,
        given_head=gate.counters[0],
        taken_head=gate.counters[1],
        given=gate.given,
        taken=gate.taken,
        mass=world.mass,
        inertia=world.inertia,
        guided=world.guided,
        drag=world.drag,
        gravity=world.gravity,
        outline_body=world.outline_body,
        outline=world.outline,
        layout=world.layout,
        index_pool=world.index,
        number_pool=world.number,
        state_pool=world.state.copy(),
        pivot=world.pivot,
        anchor=world.anchor,
        schedule=world.schedule,
        step=np.array([plan.step]),
        plan=np.array([most, plan.sample, plan.frame, plan.trigger, after], dtype=np.int64),
        probe=np.array(probes, dtype=np.int64),
        tracked=np.array(tracked, dtype=np.int64),
        pose=np.zeros((bodies + 1, 5)),
        rate=np.zeros((bodies + 1, 3)),
        move=np.zeros((bodies + 1, 3)),
        load=np.zeros((bodies + 1, 3)),
        ledger=np.zeros((laws, LEDGER)),
        power=np.zeros(laws),
        spent=np.zeros(laws),
        readings=np.zeros((samples, len(probes))),
        tracks=np.zeros((samples, len(tracked), 3)),
        accelerations=np.zeros((samples, len(tracked), 2)),
        books=np.zeros((samples, laws, 2)),
        scalars=np.zeros((samples, 3)),
        frames=np.zeros((shots, bodies, 3)),
        worst=np.zeros(2),
        outcome=np.zeros(4, dtype=np.int64),
    )
    march = loop()
    started = time.perf_counter()
    status = march(run)
    seconds = time.perf_counter() - started
    steps, filled, taken, contact = run.outcome.tolist()
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
        readings=run.readings[:filled],
        tracks=run.tracks[:filled],
        accelerations=run.accelerations[:filled],
        stored=run.books[:filled, :, 0],
        spent=run.books[:filled, :, 1],
        kinetic=run.scalars[:filled, 0],
        hinge_force=run.scalars[:filled, 1],
        contact_force=run.scalars[:filled, 2],
        frame_time=np.arange(taken) * (plan.step * plan.frame),
        frames=run.frames[:taken],
        joint_gap=float(run.worst[0]),
        penetration=float(run.worst[1]),
        steps=steps,
        seconds=seconds,
    )
