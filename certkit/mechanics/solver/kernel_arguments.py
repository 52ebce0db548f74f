"""What the compiled time loop is given: one block of addresses and shapes."""

from __future__ import annotations

from typing import Annotated, NamedTuple, get_type_hints

import numpy as np
from numpy.typing import NDArray

from certkit.mechanics.force_laws.law import CurvePoint, Load, OutlinePiece, Pose, Totals, Velocity
from certkit.mechanics.records import Record, Structured, record_type
from certkit.mechanics.solver.world import LawTable, Pivot

FINISHED, RAN_AWAY = 0, 1
"""What the loop ends with."""

WORDS = 4
"""Of the block, for each array: its address, then its extent in up to three directions."""


class BodyMotion(Record):
    """A body as pymunk's batched reading writes it."""

    x: float
    z: float
    angle: float
    velocity_x: float
    velocity_z: float
    angular_velocity: float


class PymunkAddresses(Record):
    """Addresses of pymunk's C functions and of what they take; `hinge` is 0 where none is recorded."""

    step: int
    each_body: int
    read_body: int
    write_body: int
    space: int
    read_request: int
    write_request: int
    impulse: int
    hinge: int


class StepPlan(Record):
    """The plan of a run, in steps.

    Parameters
    ----------
    most : int
        Steps after which it ends in any case.
    sample, frame : int
        Steps from one sample, and from one frame of the motion, to the next.
    trigger : int
        Number of the law whose force marks first contact; -1: contact is at the start.
    after : int
        Steps after first contact.
    length : float
        Time step, s.
    """

    most: int
    sample: int
    frame: int
    trigger: int
    after: int
    length: float


class RunState(Record):
    """What a run has come to.

    Parameters
    ----------
    steps, samples, frames : int
        Done, and recorded.
    contact : int
        Step of first contact, -1 for none.
    flesh_depth : float
        Largest depth of flesh over its thickness.
    joint_gap, penetration : float
        Largest of all samples, m.
    """

    steps: int
    samples: int
    frames: int
    contact: int
    joint_gap: float
    penetration: float
    flesh_depth: float


class SampleFigures(Record):
    """Of one sample: kinetic energy (J), force at the hinge (N), contact force (N)."""

    kinetic: float
    hinge_force: float
    contact_force: float


class AccountFigures(Record):
    """Of one sample and one energy account: energy stored, and dissipated so far, J."""

    stored: float
    dissipated: float


Vector = Annotated[NDArray[np.float64], "f8", 1]
Indices = Annotated[NDArray[np.int64], "i8", 1]
Counter = Annotated[NDArray[np.int32], "i4", 1]
Stack = Annotated[NDArray[np.float64], "f8", 3]


class KernelArguments(NamedTuple):
    """The arrays that the loop reads, works in and fills. What a world's arrays hold is said in `World`.

    Parameters
    ----------
    addresses : shape (1,)
    read_counter, write_counter : shape (2,)
        Fill count and capacity of pymunk's reading and of its writing buffer, seen in place.
    motion : shape (bodies + spare,)
        Memory of the reading buffer.
    body_load : shape (bodies + spare,)
        Memory of the writing buffer.
    mass, inertia, guided, damping, gravity, outline, curves, pivots, layout
        The world's own.
    tables
        A copy of the world's `tables`, whose states the laws change.
    plan, state : shape (1,)
    probe : shape (probes,)
        Places in `tables` that are recorded at every sample.
    tracked : shape (tracked,)
        Bodies whose pose and acceleration are recorded at every sample.
    pose, velocity, step_velocity, load : shape (bodies + 1,)
        To work in: see `certkit.mechanics.force_laws.law.Instant`.
    totals : shape (accounts,)
        To work in.
    power, dissipated : shape (accounts,)
        To work in: power dissipated a step ago (W), and energy dissipated so far (J).
    readings : shape (samples, probes)
        Filled.
    tracks : shape (samples, tracked, 3)
        Filled: x, z, angle.
    accelerations : shape (samples, tracked, 2)
        Filled: along x and z, m/s².
    accounts : shape (samples, accounts)
        Filled.
    figures : shape (samples,)
        Filled.
    frames : shape (frames, bodies, 3)
        Filled: x, z, angle.
    """

    addresses: Annotated[Structured, PymunkAddresses, 1]
    read_counter: Counter
    write_counter: Counter
    motion: Annotated[Structured, BodyMotion, 1]
    body_load: Annotated[Structured, Load, 1]
    mass: Vector
    inertia: Vector
    guided: Vector
    damping: Vector
    gravity: Vector
    outline: Annotated[Structured, OutlinePiece, 1]
    curves: Annotated[Structured, CurvePoint, 1]
    pivots: Annotated[Structured, Pivot, 1]
    layout: Annotated[Structured, LawTable, 1]
    tables: Vector
    plan: Annotated[Structured, StepPlan, 1]
    state: Annotated[Structured, RunState, 1]
    probe: Indices
    tracked: Indices
    pose: Annotated[Structured, Pose, 1]
    velocity: Annotated[Structured, Velocity, 1]
    step_velocity: Annotated[Structured, Velocity, 1]
    load: Annotated[Structured, Load, 1]
    totals: Annotated[Structured, Totals, 1]
    power: Vector
    dissipated: Vector
    readings: Annotated[NDArray[np.float64], "f8", 2]
    tracks: Stack
    accelerations: Stack
    accounts: Annotated[Structured, AccountFigures, 2]
    figures: Annotated[Structured, SampleFigures, 1]
    frames: Stack


def _kinds() -> tuple[tuple[np.dtype[np.generic], int], ...]:
    hints = get_type_hints(KernelArguments, include_extras=True).values()
    metadata = [hint.__metadata__ for hint in hints]
    return tuple((np.dtype(of) if isinstance(of, str) else record_type(of), n) for of, n in metadata)


KINDS = _kinds()
"""Element type and number of dimensions of each array."""


def block(arguments: KernelArguments) -> NDArray[np.int64]:
    """Write addresses and shapes down, shape (arrays, WORDS). The arrays must outlive it.

    Raises
    ------
    TypeError
        When an array is not what compiled code takes it for; it would read or write elsewhere.
    """
    words = np.zeros((len(KINDS), WORDS), dtype=np.int64)
    arrays: list[NDArray[np.generic]] = list(arguments)
    for row, name, array, (kind, dimensions) in zip(
        words, KernelArguments._fields, arrays, KINDS, strict=True
    ):
        if array.dtype != kind or array.ndim != dimensions or not array.flags.carray:
            raise TypeError(f"`{name}` must be a contiguous array of {kind} with {dimensions} dimensions")
        row[0] = array.ctypes.data
        row[1 : 1 + dimensions] = array.shape
    return words
