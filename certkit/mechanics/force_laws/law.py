"""What every force law declares: the columns of its tables.

A law is one small file: a `Law` that names the columns, and one compiled function that walks the rows. All
laws have the same signature, so adding one means a new file, a line in `mechanics.force_laws` and a line
in `certkit.mechanics.solver.kernel`.

A law's function is called once a step with

- `index` (rows, n) int64: the bodies it acts on; the last row of `pose` is the ground;
- `number` (rows, n) float64: its constants; `state` (rows, n) float64: what it remembers and its readings;
- `scene`: what all laws see (`Scene`);
- `load` (bodies + 1, 3): x force, z force and torque; it adds to them;
- `ledger` (5,): its books, see `STORED` and the names beside it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Heads = tuple[NDArray[np.int32], NDArray[np.int32]]

# Columns of a law's ledger.
STORED = 0  # elastic (or gravitational) energy now, J
POWER = 1  # power being dissipated now, W; negative: work done on the leg from outside
SPENT = 2  # energy dissipated so far in sudden amounts (plastic crush, slip), J
FORCE = 3  # resultant along x, N, positive towards the obstacle
DEPTH = 4  # deepest penetration of a contact now, m
LEDGER = 5

# Columns of `pose`.
X, Z, ANGLE, COS, SIN = 0, 1, 2, 3, 4


class Scene(NamedTuple):
    """What all laws see of a step.

    Parameters
    ----------
    pose : ndarray, shape (bodies + 1, 5)
        x, z, angle, its cosine and sine, at the instant the forces act. The last row is the ground.
    rate : ndarray, shape (bodies + 1, 3)
        Velocities extrapolated to that instant, for damping.
    move : ndarray, shape (bodies + 1, 3)
        Velocities over the step that leads there: `move · step` is the exact displacement, for slip.
    outline_body : ndarray of int64, shape (m,)
        Bodies of the leg from top to bottom.
    outline : ndarray, shape (m, 4)
        Of each: top and bottom above its centre of gravity, distance of its face from the axis, contact
        width.
    time, step : float
        Seconds; `step` is the length of the step that leads to this instant.
    schedule : ndarray, shape (k, 2)
        Time and force of the loading ram.
    """

    pose: Floats
    rate: Floats
    move: Floats
    outline_body: Integers
    outline: Floats
    time: float
    step: float
    schedule: Floats


@dataclass(frozen=True)
class Law:
    """The columns of one force law's tables.

    Parameters
    ----------
    name : str
        As in the energy balance.
    bodies, numbers, states : tuple of str
        Columns of `index`, `number` and `state`.
    """

    name: str
    bodies: tuple[str, ...]
    numbers: tuple[str, ...]
    states: tuple[str, ...]
