"""Run a `World` for a while: the one door between builders and the compiled loop."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.errors import RunError
from certkit.mechanics.force_laws import ENERGY_ACCOUNTS, LAWS
from certkit.mechanics.force_laws.law import Load, Pose, Totals, Velocity
from certkit.mechanics.records import blank, record_type, table_of
from certkit.mechanics.solver.kernel_arguments import (
    RAN_AWAY,
    AccountFigures,
    BodyMotion,
    KernelArguments,
    RunState,
    SampleFigures,
    StepPlan,
)
from certkit.mechanics.solver.object_cache import loop
from certkit.mechanics.solver.pymunk_space import ITERATIONS, build_space, share_memory

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.mechanics.force_laws.law import ForceLaw
    from certkit.mechanics.records import Floats
    from certkit.mechanics.solver.world import World


class Plan(Struct, frozen=True):
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
        Steps from one sample, and from one frame of the recorded motion, to the next.
    trigger : type of ForceLaw, optional
        Law whose force marks first contact; without one, contact is at the start.
    iterations : int
        Of pymunk's constraint solver.
    """

    step: float
    until: float
    longest: float
    sample: int = 1
    frame: int = 50
    trigger: type[ForceLaw] | None = None
    iterations: int = ITERATIONS


class Trajectory(Struct, frozen=True):
    """What a run yields, one row a sample.

    Parameters
    ----------
    time : ndarray, shape (s,)
        Seconds from the start.
    contact : float
        When first contact came, s from the start.
    readings : ndarray, shape (s, probes)
    tracks, accelerations : ndarray, shape (s, tracked, 3) and (s, tracked, 2)
        x, z, angle; along x and z, m/s².
    stored, dissipated : ndarray, shape (s, accounts)
        Energy stored, and dissipated so far, J; see `certkit.mechanics.force_laws.ENERGY_ACCOUNTS`.
    kinetic, hinge_force, contact_force : ndarray, shape (s,)
        J and N.
    frame_time, frames : ndarray, shape (f,) and (f, bodies, 3)
    flesh_depth : float
        Largest depth of flesh over its thickness.
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
    dissipated: Floats
    kinetic: Floats
    hinge_force: Floats
    contact_force: Floats
    frame_time: Floats
    frames: Floats
    joint_gap: float
    penetration: float
    flesh_depth: float
    steps: int
    seconds: float


MOST_STEPS, MOST_SAMPLES = 10_000_000, 1_000_000
"""More is a mistake in the procedure: it would take hours, or fill the memory."""


def _check(plan: Plan) -> None:
    wanted = f"a run of {plan.until:g} s in steps of {plan.step:g} s"
    if not (plan.step > 0 and plan.until > 0):
        raise RunError(
            f"{wanted} goes nowhere; both must be positive; correct `run.until` or `run.time step`"
        )
    if plan.until < 2 * plan.sample * plan.step:
        raise RunError(f"{wanted} is too short for two samples; give `until` more, or the step less")
    steps = max(plan.until, plan.longest) / plan.step
    if steps > MOST_STEPS or steps / plan.sample > MOST_SAMPLES:
        raise RunError(
            f"{wanted} is too long: {steps:.3g} steps; "
            f"at most {MOST_STEPS:,} are simulated and {MOST_SAMPLES:,} kept"
            "; shorten the run, or take a longer step"
        )


def run_world(
    world: World, plan: Plan, probes: Sequence[int] = (), tracked: Sequence[int] = ()
) -> Trajectory:
    """Simulate a world as planned.

    Parameters
    ----------
    world : World
    plan : Plan
    probes : sequence of int
        States of law rows to record at every sample: places by `World.place`.
    tracked : sequence of int
        Bodies whose pose and acceleration are recorded at every sample.

    Raises
    ------
    RunError
        When a body runs away or never touches what it should, or the plan is no plan.
    """
    _check(plan)
    most = round((plan.until if plan.trigger is None else plan.longest) / plan.step)
    samples, frames = most // plan.sample + 1, most // plan.frame + 1
    space = build_space(world, plan.step, plan.iterations)
    shared = share_memory(space, world)
    bodies, accounts = len(world.names), len(ENERGY_ACCOUNTS)
    steps = StepPlan(
        most=most,
        sample=plan.sample,
        frame=plan.frame,
        trigger=-1 if plan.trigger is None else LAWS.index(plan.trigger),
        after=round(plan.until / plan.step),
        length=plan.step,
    )
    run = KernelArguments(
        addresses=shared.addresses,
        read_counter=shared.read_counter,
        write_counter=shared.write_counter,
        motion=shared.motion.view(record_type(BodyMotion)),
        body_load=shared.load.view(record_type(Load)),
        mass=world.mass,
        inertia=world.inertia,
        guided=world.guided,
        damping=world.damping,
        gravity=world.gravity,
        outline=world.outline,
        curves=world.curves,
        pivots=world.pivots,
        layout=world.layout,
        tables=world.tables.copy(),
        plan=table_of(StepPlan, [steps]),
        state=blank(RunState, 1),
        probe=np.array(probes, dtype=np.int64),
        tracked=np.array(tracked, dtype=np.int64),
        pose=blank(Pose, bodies + 1),
        velocity=blank(Velocity, bodies + 1),
        step_velocity=blank(Velocity, bodies + 1),
        load=blank(Load, bodies + 1),
        totals=blank(Totals, accounts),
        power=np.zeros(accounts),
        dissipated=np.zeros(accounts),
        readings=np.zeros((samples, len(probes))),
        tracks=np.zeros((samples, len(tracked), 3)),
        accelerations=np.zeros((samples, len(tracked), 2)),
        accounts=blank(AccountFigures, samples, accounts),
        figures=blank(SampleFigures, samples),
        frames=np.zeros((frames, bodies, 3)),
    )
    time_loop = loop()
    started = time.perf_counter()
    status = time_loop(run)
    seconds = time.perf_counter() - started
    state = RunState(*run.state[0].tolist())
    if status == RAN_AWAY:
        raise RunError(
            f"the simulation ran away after {state.steps * plan.step * 1e3:.3f} ms: a spring, damper or "
            f"contact is too stiff for a time step of {plan.step:g} s; try half of it, or look at what was "
            "changed last"
        )
    if state.contact < 0:
        raise RunError(
            f"nothing was touched within {plan.longest:g} s; check the release and the place of the obstacle"
        )
    filled, taken = state.samples, state.frames
    return Trajectory(
        time=np.arange(filled, dtype=np.float64) * (plan.step * plan.sample),
        contact=state.contact * plan.step,
        readings=run.readings[:filled],
        tracks=run.tracks[:filled],
        accelerations=run.accelerations[:filled],
        stored=run.accounts["stored"][:filled],
        dissipated=run.accounts["dissipated"][:filled],
        kinetic=run.figures["kinetic"][:filled],
        hinge_force=run.figures["hinge_force"][:filled],
        contact_force=run.figures["contact_force"][:filled],
        frame_time=np.arange(taken, dtype=np.float64) * (plan.step * plan.frame),
        frames=run.frames[:taken],
        joint_gap=state.joint_gap,
        penetration=state.penetration,
        flesh_depth=state.flesh_depth,
        steps=state.steps,
        seconds=seconds,
    )
