"""The compiled time loop: read the bodies, evaluate all force laws, hand the forces to pymunk, step.

The scheme is leapfrog, see `certkit.mechanics.solver.bodies.predict`. The laws' part of the loop is composed
from `certkit.mechanics.force_laws.LAWS`: this file knows none of them.

This module is imported only to compile the loop; `solver.object_cache` loads what came of it. All
memory comes from outside, and what numpy would say in one line is written out: it compiles in half the time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws import LAWS
from certkit.mechanics.force_laws.law import Instant
from certkit.mechanics.records import record_type
from certkit.mechanics.solver.bodies import add_weight_and_damping, kinetic_energy, predict, widest_gap
from certkit.mechanics.solver.intrinsics import (
    arguments_at,
    call_each,
    call_impulse,
    call_step,
    table_reader,
)
from certkit.mechanics.solver.kernel_arguments import FINISHED, RAN_AWAY, KernelArguments

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.mechanics.force_laws.law import ForceLaw, Load, Totals
    from certkit.mechanics.records import Floats, Rows
    from certkit.mechanics.solver.kernel_arguments import AccountFigures
    from certkit.mechanics.solver.world import LawTable

    AllLaws: TypeAlias = Callable[[Rows[LawTable], Floats, Instant, Rows[Load], Rows[Totals]], None]


@compiled
def _no_law(
    layout: Rows[LawTable], tables: Floats, now: Instant, load: Rows[Load], totals: Rows[Totals]
) -> None:
    """Evaluate nothing: what the first law is added to."""


def _and(before: AllLaws, law: type[ForceLaw], number: int) -> AllLaws:
    """Return a function that evaluates the laws before, and then this one."""
    table = table_reader(record_type(law))
    forces = law.forces

    @compiled
    def evaluate(
        layout: Rows[LawTable], tables: Floats, now: Instant, load: Rows[Load], totals: Rows[Totals]
    ) -> None:
        before(layout, tables, now, load, totals)
        forces(table(tables, layout[number].start, layout[number].rows), now, load, totals[number])

    return evaluate


def _all_laws() -> AllLaws:
    composed: AllLaws = _no_law
    for number, law in enumerate(LAWS):
        composed = _and(composed, law, number)
    return composed


evaluate_laws = _all_laws()
"""Evaluate all force laws at an instant: it adds to `load` and `totals`, and changes the tables' states."""


@compiled
def clear_totals(totals: Rows[Totals]) -> None:
    """Set the totals of a step to zero; what was dissipated in sudden amounts goes on adding up."""
    for a in range(len(totals)):
        account = totals[a]
        account.stored = 0.0
        account.power = 0.0
        account.force = 0.0
        account.penetration = 0.0
        account.flesh_depth = 0.0


@compiled
def dissipate(totals: Rows[Totals], power: Floats, dissipated: Floats, half: float) -> None:
    """Add what the last step dissipated, ∫P dt by the trapezoidal rule, and keep the power for the next.

    `power` P (W) and `dissipated` (J) have the shape (accounts,); `half` is half a step, s.
    """
    for a in range(len(totals)):
        dissipated[a] += half * (power[a] + totals[a].power)
        power[a] = totals[a].power


@compiled
def write_loads(run: KernelArguments) -> None:
    """Put each body's force and torque where pymunk reads them; guided bodies take none along z."""
    for i in range(run.mass.shape[0]):
        run.body_load[i].x = run.load[i].x
        run.body_load[i].z = run.load[i].z * (1.0 - run.guided[i])
        run.body_load[i].torque = run.load[i].torque


@compiled
def add_up(
    totals: Rows[Totals], dissipated: Floats, accounts: Rows[AccountFigures]
) -> tuple[float, float, float]:
    """Write energies by account; return contact force (N), penetration (m), flesh depth over thickness.

    `dissipated` (J), like `totals` and `accounts`, has the shape (accounts,).
    """
    force = deepest = flesh = 0.0
    for a in range(len(totals)):
        accounts[a].stored = totals[a].stored
        accounts[a].dissipated = dissipated[a] + totals[a].dissipated
        force += totals[a].force
        deepest = max(deepest, totals[a].penetration)
        flesh = max(flesh, totals[a].flesh_depth)
    return force, deepest, flesh


@compiled
def record_sample(run: KernelArguments, at: int, length: float) -> None:
    """Record what is known of a sample before the step; the rest follows after it."""
    for j in range(run.probe.shape[0]):
        run.readings[at, j] = run.tables[run.probe[j]]
    for j in range(run.tracked.shape[0]):
        pose = run.pose[run.tracked[j]]
        run.tracks[at, j, 0] = pose.x
        run.tracks[at, j, 1] = pose.z
        run.tracks[at, j, 2] = pose.angle
    force, deepest, flesh = add_up(run.totals, run.dissipated, run.accounts[at])
    pymunk, state = run.addresses[0], run.state[0]
    hinge_force = call_impulse(pymunk.impulse, pymunk.hinge) / length if pymunk.hinge != 0 else 0.0
    run.figures[at].hinge_force = hinge_force
    run.figures[at].contact_force = force
    state.joint_gap = max(state.joint_gap, widest_gap(run.pose, run.pivots))
    state.penetration = max(state.penetration, deepest)
    state.flesh_depth = max(state.flesh_depth, flesh)


@compiled
def complete_sample(run: KernelArguments, at: int, share: float, length: float) -> None:
    """Complete a sample, whose instant lies between the half steps before and after it."""
    motion, before = run.motion, run.step_velocity
    run.figures[at].kinetic = kinetic_energy(motion, before, share, run.mass, run.inertia)
    for j in range(run.tracked.shape[0]):
        i = run.tracked[j]
        run.accelerations[at, j, 0] = (motion[i].velocity_x - before[i].x) / length
        run.accelerations[at, j, 1] = (motion[i].velocity_z - before[i].z) / length


@compiled
def record_frame(run: KernelArguments, at: int) -> None:
    """Record the poses of all bodies."""
    for i in range(run.mass.shape[0]):
        run.frames[at, i, 0] = run.pose[i].x
        run.frames[at, i, 1] = run.pose[i].z
        run.frames[at, i, 2] = run.pose[i].angle


def time_loop(address: int) -> int:
    """Step until the plan is fulfilled.

    Parameters
    ----------
    address : int
        Of the block of `KernelArguments`.

    Returns
    -------
    int
        FINISHED or RAN_AWAY; all else is in the arrays.
    """
    run: KernelArguments = arguments_at(address)
    pymunk, plan, state = run.addresses[0], run.plan[0], run.state[0]
    bodies, step = run.mass.shape[0], plan.length
    contact = 0 if plan.trigger < 0 else -1
    end = plan.after if plan.trigger < 0 else plan.most
    samples = frames = 0
    pending = False
    length = 0.5 * step  # bodies start half a step before time zero
    run.pose[bodies].cos = 1.0
    status = FINISHED
    k = 0
    while True:
        run.read_counter[0] = 0
        call_each(pymunk.each_body, pymunk.space, pymunk.read_body, pymunk.read_request)
        if pending:
            complete_sample(run, samples, 0.5 if k > 1 else 0.0, length)
            samples += 1
            pending = False
        if k > end or k > plan.most or samples == run.readings.shape[0]:
            break
        if k == 1:
            length = step
        share = 0.0 if k == 0 else (1.0 if k == 1 else 0.5)
        if not predict(run.motion, share, length, run.pose, run.velocity, run.step_velocity):
            status = RAN_AWAY
            break
        clear_totals(run.totals)
        now = Instant(run.pose, run.velocity, run.step_velocity, run.outline, run.curves, k * step, length)
        add_weight_and_damping(run.mass, run.damping, run.gravity, now, run.load, run.totals)
        evaluate_laws(run.layout, run.tables, now, run.load, run.totals)
        dissipate(run.totals, run.power, run.dissipated, 0.5 * step if k > 0 else 0.0)
        write_loads(run)
        run.write_counter[0] = 0
        call_each(pymunk.each_body, pymunk.space, pymunk.write_body, pymunk.write_request)
        call_step(pymunk.step, pymunk.space, length)
        if contact < 0 and run.totals[plan.trigger].force > 0.0:
            contact = k
            end = k + plan.after
        if k % plan.sample == 0:
            record_sample(run, samples, length)
            pending = True
        if k % plan.frame == 0 and frames < run.frames.shape[0]:
            record_frame(run, frames)
            frames += 1
        k += 1
    state.steps = k
    state.samples = samples
    state.frames = frames
    state.contact = contact
    return status
