"""What the compiled loop is given: one block of addresses and shapes, so that a single number calls it."""

from __future__ import annotations

from typing import Annotated, NamedTuple, get_type_hints

import numpy as np
from numpy.typing import NDArray

Heads = Annotated[NDArray[np.int32], "i4", 1]
Indices = Annotated[NDArray[np.int64], "i8", 1]
IndexTable = Annotated[NDArray[np.int64], "i8", 2]
Vector = Annotated[NDArray[np.float64], "f8", 1]
Table = Annotated[NDArray[np.float64], "f8", 2]
Stack = Annotated[NDArray[np.float64], "f8", 3]

FINISHED, RAN_AWAY = 0, 1
"""What the loop ends with."""

WORDS = 4
"""Of the block, for each array: its address, then its extent in up to three directions."""


class Handover(NamedTuple):
    """The arrays that the loop reads, works in and fills. What a world's arrays hold is said in `World`.

    Parameters
    ----------
    entry : shape (9,)
        Addresses: step, each body, get, set, space, get data, set data, impulse, hinge constraint (0: none).
    given_head, taken_head : shape (2,)
        Fill count and capacity of pymunk's get buffer and of its set buffer, seen in place.
    given, taken
        Memory of the get buffer (x, z, angle, velocities of each body) and of the set buffer (force, torque).
    mass, inertia, guided, drag, gravity, outline_body, outline, layout, pivot, anchor, schedule
        The world's own; `index_pool` and `number_pool` are its `index` and `number`.
    state_pool
        A copy of the world's `state`, which the laws change.
    step : shape (1,)
        Time step, s.
    plan : shape (5,)
        Most steps; steps a sample; steps a frame; law whose force marks first contact (-1: contact at once);
        steps after it.
    probe, tracked
        Places in `state_pool`, and bodies, that are recorded.
    pose, rate, move, load : shape (bodies + 1, …)
        To work in: see `certkit.mechanics.force_laws.law.Scene`.
    ledger : shape (laws, LEDGER)
        Likewise.
    power, spent : shape (laws,)
        Likewise: power dissipated a step ago, and energy dissipated so far.
    readings, tracks, accelerations, books, scalars, frames, worst
        Filled: probed state, tracked poses and accelerations, energies by book, (kinetic energy, hinge force,
        contact force), poses of all bodies, (joint gap, penetration).
    outcome : shape (4,)
        Filled: steps, samples, frames, step of first contact (-1: none).
    """

    entry: Indices
    given_head: Heads
    taken_head: Heads
    given: Vector
    taken: Vector
    mass: Vector
    inertia: Vector
    guided: Vector
    drag: Vector
    gravity: Vector
    outline_body: Indices
    outline: Table
    layout: IndexTable
    index_pool: Indices
    number_pool: Vector
    state_pool: Vector
    pivot: IndexTable
    anchor: Table
    schedule: Table
    step: Vector
    plan: Indices
    probe: Indices
    tracked: Indices
    pose: Table
    rate: Table
    move: Table
    load: Table
    ledger: Table
    power: Vector
    spent: Vector
    readings: Table
    tracks: Stack
    accelerations: Stack
    books: Stack
    scalars: Table
    frames: Stack
    worst: Vector
    outcome: Indices


KINDS: tuple[tuple[str, int], ...] = tuple(
    hint.__metadata__ for hint in get_type_hints(Handover, include_extras=True).values()
)
"""Element type and number of dimensions of each array."""


def block(handover: Handover) -> NDArray[np.int64]:
    """Write addresses and shapes down, shape (arrays, WORDS). The arrays must outlive it.

    Raises
    ------
    TypeError
        When an array is not what compiled code takes it for; it would read or write elsewhere.
    """
    words = np.zeros((len(KINDS), WORDS), dtype=np.int64)
    arrays: list[NDArray[np.generic]] = list(handover)
    for row, name, array, (code, dimensions) in zip(words, Handover._fields, arrays, KINDS, strict=True):
        if array.dtype != code or array.ndim != dimensions or not array.flags.carray:
            raise TypeError(f"`{name}` must be a contiguous array of {code} with {dimensions} dimensions")
        row[0] = array.ctypes.data
        row[1 : 1 + dimensions] = array.shape
    return words
