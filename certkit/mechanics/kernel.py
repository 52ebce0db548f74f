"""The compiled time loop: read the bodies, evaluate all force laws, hand the forces to pymunk, step.

`cpSpaceStep` moves bodies before it changes their speeds, so forces are evaluated where the bodies will be:
that is the leapfrog scheme, second order and energy-keeping. Damping needs the speed at that same instant,
which is extrapolated from the last two half steps. All arguments are flat arrays and plain numbers.
"""

from __future__ import annotations

import hashlib
import math
from pathlib import Path
from typing import Any, cast

from numba import njit

from certkit.mechanics.laws import (
    BENDING,
    CABLES,
    CONDYLES,
    CRUSH,
    CUSHION,
    DRAG,
    FLESH,
    FRONT,
    GRAVITY,
    LOADING,
    NOSE,
    POINTS,
    SPRINGS,
    SUPPORTS,
)
from certkit.mechanics.laws.bending import bend
from certkit.mechanics.laws.cables import pull
from certkit.mechanics.laws.compiling import compiled
from certkit.mechanics.laws.condyles import press
from certkit.mechanics.laws.crush import crush
from certkit.mechanics.laws.cushion import squeeze
from certkit.mechanics.laws.flesh import hang
from certkit.mechanics.laws.front import slide
from certkit.mechanics.laws.loading import push
from certkit.mechanics.laws.nose import lean
from certkit.mechanics.laws.spring import stretch
from certkit.mechanics.laws.supports import carry
from certkit.mechanics.laws.table import (
    ANGLE,
    COS,
    DEPTH,
    FORCE,
    POWER,
    SIN,
    SPENT,
    STORED,
    Floats,
    Heads,
    Integers,
    Scene,
    X,
    Z,
)
from certkit.mechanics.native import call_each, call_impulse, call_step

FASTEST = 1e3  # m/s or rad/s: a body beyond it has run away

FINISHED, RAN_AWAY = 0, 1

Table = tuple[Integers, Floats, Floats]


@compiled
def table(layout: Integers, law: int, index: Integers, number: Floats, state: Floats) -> Table:
    """Cut a law's three tables out of the pools. A row of `layout`: rows, then offset and columns of each."""
    rows, i, ci, n, cn, s, cs = layout[law]
    return (
        index[i : i + rows * ci].reshape((rows, ci)),
        number[n : n + rows * cn].reshape((rows, cn)),
        state[s : s + rows * cs].reshape((rows, cs)),
    )


@compiled
def weigh(  # compiled code takes flat arrays
    mass: Floats,
    drag: Floats,
    gravity: Floats,
    scene: Scene,
    load: Floats,
    ledger: Floats,
) -> None:
    """Start each body's load with its weight and mass damping."""
    pose, rate = scene.pose, scene.rate
    for i in range(mass.shape[0]):
        m, damping = mass[i], mass[i] * drag[i]
        load[i, 0] = m * gravity[0] - damping * rate[i, 0]
        load[i, 1] = m * gravity[1] - damping * rate[i, 1]
        load[i, 2] = 0.0
        ledger[GRAVITY, STORED] -= m * (gravity[0] * pose[i, X] + gravity[1] * pose[i, Z])
        ledger[DRAG, POWER] += damping * (rate[i, 0] * rate[i, 0] + rate[i, 1] * rate[i, 1])


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


@compiled
def predict(  # compiled code takes flat arrays
    buffer: Floats,
    last: Floats,
    share: float,
    step: float,
    pose: Floats,
    rate: Floats,
    move: Floats,
) -> bool:
    """Carry the bodies in pymunk's `buffer` on by `step`; False when one of them has run away."""
    sane = True
    for i in range(pose.shape[0] - 1):
        for k in range(3):
            v = buffer[6 * i + 3 + k]
            move[i, k] = v
            rate[i, k] = v + share * (v - last[i, k])
            sane = sane and abs(v) < FASTEST
        pose[i, X] = buffer[6 * i] + step * move[i, 0]
        pose[i, Z] = buffer[6 * i + 1] + step * move[i, 1]
        angle = buffer[6 * i + 2] + step * move[i, 2]
        pose[i, ANGLE] = angle
        pose[i, COS] = math.cos(angle)
        pose[i, SIN] = math.sin(angle)
    return sane


@compiled
def widest_gap(pose: Floats, pivot: Integers, anchor: Floats) -> float:
    """Return the largest distance between the two halves of a pivot."""
    widest = 0.0
    for i in range(pivot.shape[0]):
        a, b = pivot[i, 0], pivot[i, 1]
        dx = pose[a, X] + pose[a, COS] * anchor[i, 0] - pose[a, SIN] * anchor[i, 1]
        dx -= pose[b, X] + pose[b, COS] * anchor[i, 2] - pose[b, SIN] * anchor[i, 3]
        dz = pose[a, Z] + pose[a, SIN] * anchor[i, 0] + pose[a, COS] * anchor[i, 1]
        dz -= pose[b, Z] + pose[b, SIN] * anchor[i, 2] + pose[b, COS] * anchor[i, 3]
        widest = max(widest, math.sqrt(dx * dx + dz * dz))
    return widest


@compiled
def kinetic_energy(given: Floats, move: Floats, half: float, mass: Floats, inertia: Floats) -> float:
    """Return the kinetic energy between two half steps: `move` before the instant, `given` after it."""
    total = 0.0
    for i in range(mass.shape[0]):
        vx = move[i, 0] + half * (given[6 * i + 3] - move[i, 0])
        vz = move[i, 1] + half * (given[6 * i + 4] - move[i, 1])
        w = move[i, 2] + half * (given[6 * i + 5] - move[i, 2])
        total += 0.5 * (mass[i] * (vx * vx + vz * vz) + inertia[i] * w * w)
    return total


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


def march(  # noqa: C901, PLR0912, PLR0913, PLR0915, PLR0917  # one loop, compiled as a whole
    entry: Integers,
    counters: Heads,
    given: Floats,
    taken: Floats,
    mass: Floats,
    inertia: Floats,
    guided: Floats,
    drag: Floats,
    gravity: Floats,
    outline_body: Integers,
    outline: Floats,
    layout: Integers,
    index: Integers,
    number: Floats,
    state: Floats,
    pivot: Integers,
    anchor: Floats,
    schedule: Floats,
    step: float,
    plan: Integers,
    probe: Integers,
    tracked: Integers,
    pose: Floats,
    rate: Floats,
    move: Floats,
    load: Floats,
    ledger: Floats,
    readings: Floats,
    tracks: Floats,
    accelerations: Floats,
    books: Floats,
    scalars: Floats,
    frames: Floats,
    worst: Floats,
) -> tuple[int, int, int, int, int]:
    """March until the plan is fulfilled.

    What the plan's arrays hold is said in `certkit.mechanics.loop` and `certkit.mechanics.world`.

    Parameters
    ----------
    entry : ndarray of int64, shape (9,)
        Addresses: step, each body, get, set, space, get data, set data, impulse, hinge constraint (0: none).
    counters : two ndarrays of int32, shape (2,)
        Fill count and capacity of pymunk's get buffer and of its set buffer, seen in place.
    given, taken : ndarray
        Memory of the get buffer (x, z, angle, velocities of each body) and of the set buffer (force and
        torque).
    plan : ndarray of int64, shape (5,)
        Most steps; steps a sample; steps a frame; law whose force marks first contact (-1: contact at
        once); steps after it.
    readings, tracks, accelerations, books, scalars, frames, worst : ndarray
        Filled: probed state, tracked poses and accelerations, energies by book, (kinetic energy, hinge
        force, contact force), poses of all bodies, (joint gap, penetration).

    Returns
    -------
    status, steps, samples, frames, contact step : int
    """
    bodies = mass.shape[0]
    count_given, count_taken = counters
    tables = (
        table(layout, BENDING, index, number, state),
        table(layout, CABLES, index, number, state),
        table(layout, CONDYLES, index, number, state),
        table(layout, FLESH, index, number, state),
        table(layout, CUSHION, index, number, state),
        table(layout, CRUSH, index, number, state),
        table(layout, SUPPORTS, index, number, state),
        table(layout, LOADING, index, number, state),
        table(layout, NOSE, index, number, state),
        table(layout, FRONT, index, number, state),
        table(layout, POINTS, index, number, state),
        table(layout, SPRINGS, index, number, state),
    )
    most, stride, frame_stride, trigger, after = plan
    contact = 0 if trigger < 0 else -1
    end = after if trigger < 0 else most
    samples = shots = 0
    pending = False
    length = 0.5 * step
    pose[bodies, COS] = 1.0
    last = move.copy()
    old_power = ledger[:, POWER].copy()
    spent = ledger[:, POWER].copy()
    k = 0
    while True:
        count_given[0] = 0
        call_each(entry[1], entry[4], entry[2], entry[5])
        if pending:
            # The last sample's instant lies between the half steps before and after it.
            scalars[samples, 0] = kinetic_energy(given, move, 0.5 if k > 1 else 0.0, mass, inertia)
            for j in range(tracked.shape[0]):
                i = tracked[j]
                accelerations[samples, j, 0] = (given[6 * i + 3] - move[i, 0]) / length
                accelerations[samples, j, 1] = (given[6 * i + 4] - move[i, 1]) / length
            samples += 1
            pending = False
        if k > end or k > most or samples == readings.shape[0]:
            return FINISHED, k, samples, shots, contact
        if k == 1:
            length = step
        last[:] = move
        share = 0.0 if k == 0 else (1.0 if k == 1 else 0.5)
        if not predict(given, last, share, length, pose, rate, move):
            return RAN_AWAY, k, samples, shots, contact
        for column in (STORED, POWER, FORCE, DEPTH):
            ledger[:, column] = 0.0
        scene = Scene(pose, rate, move, outline_body, outline, k * step, length, schedule)
        weigh(mass, drag, gravity, scene, load, ledger)
        act(tables, scene, load, ledger)
        if k > 0:
            spent += 0.5 * step * (old_power + ledger[:, POWER])
        old_power[:] = ledger[:, POWER]
        load[:bodies, 1] *= 1.0 - guided
        taken[: 3 * bodies] = load[:bodies].ravel()
        count_taken[0] = 0
        call_each(entry[1], entry[4], entry[3], entry[6])
        call_step(entry[0], entry[4], length)
        if contact < 0 and ledger[trigger, FORCE] > 0.0:
            contact = k
            end = k + after
        if k % stride == 0:
            pending = True
            for j in range(probe.shape[0]):
                readings[samples, j] = state[probe[j]]
            for j in range(tracked.shape[0]):
                tracks[samples, j, :] = pose[tracked[j], :3]
            force, deepest = add_up(ledger, spent, books[samples])
            scalars[samples, 1] = call_impulse(entry[7], entry[8]) / length if entry[8] != 0 else 0.0
            scalars[samples, 2] = force
            worst[0] = max(worst[0], widest_gap(pose, pivot, anchor))
            worst[1] = max(worst[1], deepest)
        if k % frame_stride == 0 and shots < frames.shape[0]:
            frames[shots] = pose[:bodies, :3]
            shots += 1
        k += 1


def _stamp(folder: Path) -> tuple[str, int]:
    """Return what changes when any source of the loop does: numba looks at the cached function's own file."""
    digest = hashlib.sha256()
    sources = [folder / "kernel.py", folder / "native.py", *sorted(folder.glob("laws/*.py"))]
    for source in sources:
        digest.update(source.read_bytes())
    return digest.hexdigest(), len(sources)


compiled_march = cast("Any", njit(cache=True, error_model="numpy")(march))
compiled_march._cache._cache_file._source_stamp = _stamp(Path(__file__).parent)  # noqa: SLF001  # no public way
