"""The compiled time loop: read the bodies, evaluate all force laws, hand the forces to pymunk, step.

`cpSpaceStep` moves bodies before it changes their speeds, so forces are evaluated where the bodies will be:
that is the leapfrog scheme, second order and energy-keeping. Damping needs the speed at that same instant,
which is extrapolated from the last two half steps.

This module is imported only to compile the loop; `solver.object_cache` loads what came of it. All
memory comes from outside, and what numpy would say in one line is written out: it compiles in half the time.
"""

from __future__ import annotations

from certkit.mechanics.force_laws import (
    BENDING,
    CABLES,
    CONDYLES,
    CRUSH,
    CUSHION,
    FLESH,
    FRONT,
    GUIDE,
    LOADING,
    NOSE,
    POINTS,
    SPRINGS,
    SUPPORTS,
)
from certkit.mechanics.force_laws.condyle_contact import press
from certkit.mechanics.force_laws.flesh_compression import squeeze
from certkit.mechanics.force_laws.flesh_suspension import hang
from certkit.mechanics.force_laws.honeycomb import crush
from certkit.mechanics.force_laws.joint_spring import bend
from certkit.mechanics.force_laws.law import (
    COS,
    DEPTH,
    FORCE,
    POWER,
    SPENT,
    STORED,
    Floats,
    Integers,
    Scene,
)
from certkit.mechanics.force_laws.ligament_cable import pull
from certkit.mechanics.force_laws.loading_ram_force import push
from certkit.mechanics.force_laws.ram_nose_contact import lean
from certkit.mechanics.force_laws.sliding_guide import guide
from certkit.mechanics.force_laws.support_roller import carry
from certkit.mechanics.force_laws.vehicle_front_contact import slide
from certkit.mechanics.force_laws.vehicle_spring import stretch
from certkit.mechanics.solver.bodies import kinetic_energy, predict, weigh, widest_gap
from certkit.mechanics.solver.compiling import compiled
from certkit.mechanics.solver.intrinsics import call_each, call_impulse, call_step, grid, handed_over
from certkit.mechanics.solver.kernel_arguments import FINISHED, RAN_AWAY, Handover, IndexTable

Table = tuple[Integers, Floats, Floats]


@compiled
def table(at: Integers, index: Integers, number: Floats, state: Floats) -> Table:
    """Cut a law's three tables out of the pools. A row of `layout`: rows, then offset and columns of each."""
    return (
        grid(index, at[1], at[0], at[2]),
        grid(number, at[3], at[0], at[4]),
        grid(state, at[5], at[0], at[6]),
    )


@compiled
def act(tables: tuple[Table, ...], scene: Scene, load: Floats, ledger: Floats) -> None:
    """Walk all force laws."""
    bend(*tables[BENDING], scene, load, ledger[BENDING])
    pull(*tables[CABLES], scene, load, ledger[CABLES])
    press(*tables[CONDYLES], scene, load, ledger[CONDYLES])
    hang(*tables[FLESH], scene, load, ledger[FLESH])
    squeeze(*tables[CUSHION], scene, load, ledger[CUSHION])
    crush(*tables[CRUSH], scene, load, ledger[CRUSH])
    carry(*tables[SUPPORTS], scene, load, ledger[SUPPORTS])
    push(*tables[LOADING], scene, load, ledger[LOADING])
    lean(*tables[NOSE], scene, load, ledger[NOSE])
    slide(*tables[FRONT], scene, load, ledger[FRONT])
    stretch(*tables[SPRINGS], tables[POINTS][1], scene, load, ledger[SPRINGS])
    guide(*tables[GUIDE], scene, load, ledger[GUIDE])


@compiled
def tables_of(layout: IndexTable, index: Integers, number: Floats, state: Floats) -> tuple[Table, ...]:
    """Cut out the tables of all laws, in their order."""
    return (
        table(layout[BENDING], index, number, state),
        table(layout[CABLES], index, number, state),
        table(layout[CONDYLES], index, number, state),
        table(layout[FLESH], index, number, state),
        table(layout[CUSHION], index, number, state),
        table(layout[CRUSH], index, number, state),
        table(layout[SUPPORTS], index, number, state),
        table(layout[LOADING], index, number, state),
        table(layout[NOSE], index, number, state),
        table(layout[FRONT], index, number, state),
        table(layout[POINTS], index, number, state),
        table(layout[SPRINGS], index, number, state),
        table(layout[GUIDE], index, number, state),
    )


@compiled
def clear(ledger: Floats) -> None:
    """Begin a step's books; only what has been spent in sudden amounts goes on."""
    for b in range(ledger.shape[0]):
        ledger[b, STORED] = ledger[b, POWER] = ledger[b, FORCE] = ledger[b, DEPTH] = 0.0


@compiled
def spend(ledger: Floats, power: Floats, spent: Floats, half: float) -> None:
    """Add what the last step dissipated, by the trapezoidal rule, and remember the power."""
    for b in range(ledger.shape[0]):
        spent[b] += half * (power[b] + ledger[b, POWER])
        power[b] = ledger[b, POWER]


@compiled
def hand_back(run: Handover) -> None:
    """Give pymunk each body's force and torque; guided bodies take none along z."""
    for i in range(run.mass.shape[0]):
        run.taken[3 * i] = run.load[i, 0]
        run.taken[3 * i + 1] = run.load[i, 1] * (1.0 - run.guided[i])
        run.taken[3 * i + 2] = run.load[i, 2]


@compiled
def add_up(ledger: Floats, spent: Floats, book: Floats) -> tuple[float, float]:
    """Write a sample's books, stored and spent by law; return contact force and deepest penetration."""
    force = deepest = 0.0
    for b in range(ledger.shape[0]):
        book[b, 0] = ledger[b, STORED]
        book[b, 1] = spent[b] + ledger[b, SPENT]
        force += ledger[b, FORCE]
        deepest = max(deepest, ledger[b, DEPTH])
    return force, deepest


@compiled
def sample(run: Handover, at: int, length: float) -> None:
    """Write down what is known of a sample before the step; the rest follows after it."""
    entry = run.entry
    for j in range(run.probe.shape[0]):
        run.readings[at, j] = run.state_pool[run.probe[j]]
    for j in range(run.tracked.shape[0]):
        for q in range(3):
            run.tracks[at, j, q] = run.pose[run.tracked[j], q]
    force, deepest = add_up(run.ledger, run.spent, run.books[at])
    run.scalars[at, 1] = call_impulse(entry[7], entry[8]) / length if entry[8] != 0 else 0.0
    run.scalars[at, 2] = force
    run.worst[0] = max(run.worst[0], widest_gap(run.pose, run.pivot, run.anchor))
    run.worst[1] = max(run.worst[1], deepest)


@compiled
def complete(run: Handover, at: int, share: float, length: float) -> None:
    """Complete a sample, whose instant lies between the half steps before and after it."""
    given, move = run.given, run.move
    run.scalars[at, 0] = kinetic_energy(given, move, share, run.mass, run.inertia)
    for j in range(run.tracked.shape[0]):
        i = run.tracked[j]
        run.accelerations[at, j, 0] = (given[6 * i + 3] - move[i, 0]) / length
        run.accelerations[at, j, 1] = (given[6 * i + 4] - move[i, 1]) / length


@compiled
def shoot(run: Handover, at: int) -> None:
    """Take a frame of the moving picture."""
    for i in range(run.mass.shape[0]):
        for q in range(3):
            run.frames[at, i, q] = run.pose[i, q]


@compiled
def conclude(outcome: Integers, steps: int, samples: int, shots: int, contact: int) -> None:
    """Write the outcome down."""
    outcome[0] = steps
    outcome[1] = samples
    outcome[2] = shots
    outcome[3] = contact


def march(address: int) -> int:
    """March until the plan is fulfilled.

    Parameters
    ----------
    address : int
        Of the block of a `Handover`.

    Returns
    -------
    int
        FINISHED or RAN_AWAY; all else is in the handover's arrays.
    """
    run: Handover = handed_over(address)
    tables = tables_of(run.layout, run.index_pool, run.number_pool, run.state_pool)
    entry, plan, ledger = run.entry, run.plan, run.ledger
    bodies, step = run.mass.shape[0], run.step[0]
    most, stride, frame_stride, trigger, after = plan[0], plan[1], plan[2], plan[3], plan[4]
    contact = 0 if trigger < 0 else -1
    end = after if trigger < 0 else most
    samples = shots = 0
    pending = False
    length = 0.5 * step
    run.pose[bodies, COS] = 1.0
    status = FINISHED
    k = 0
    while True:
        run.given_head[0] = 0
        call_each(entry[1], entry[4], entry[2], entry[5])
        if pending:
            complete(run, samples, 0.5 if k > 1 else 0.0, length)
            samples += 1
            pending = False
        if k > end or k > most or samples == run.readings.shape[0]:
            break
        if k == 1:
            length = step
        share = 0.0 if k == 0 else (1.0 if k == 1 else 0.5)
        if not predict(run.given, share, length, run.pose, run.rate, run.move):
            status = RAN_AWAY
            break
        clear(ledger)
        scene = Scene(
            run.pose, run.rate, run.move, run.outline_body, run.outline, k * step, length, run.schedule
        )
        weigh(run.mass, run.drag, run.gravity, scene, run.load, ledger)
        act(tables, scene, run.load, ledger)
        spend(ledger, run.power, run.spent, 0.5 * step if k > 0 else 0.0)
        hand_back(run)
        run.taken_head[0] = 0
        call_each(entry[1], entry[4], entry[3], entry[6])
        call_step(entry[0], entry[4], length)
        if contact < 0 and ledger[trigger, FORCE] > 0.0:
            contact = k
            end = k + after
        if k % stride == 0:
            sample(run, samples, length)
            pending = True
        if k % frame_stride == 0 and shots < run.frames.shape[0]:
            shoot(run, shots)
            shots += 1
        k += 1
    conclude(run.outcome, k, samples, shots, contact)
    return status
