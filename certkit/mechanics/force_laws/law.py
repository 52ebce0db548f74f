"""What a force law is, and what all laws see of a time step.

A force law is one class in one file: its docstring gives formula, units and source; its fields are the
parameters and the state of one row of its table (one ligament, one strip of honeycomb …); its function
`forces` walks the rows. Adding a law takes the new file and one line in `certkit.mechanics.force_laws`:
builders add rows (`assembly.add(LigamentCable(upper=…, …))`), the time loop is composed from the list.

Axes: x towards the obstacle, z up, angles positive anticlockwise seen from -y. All in SI units.
"""

from __future__ import annotations

import re
from typing import Any, ClassVar, NamedTuple

from certkit.mechanics.records import Record, Rows


class Pose(Record):
    """Where a body is, at the instant the forces act: centre of gravity (m), angle (rad), cosine and sine."""

    x: float
    z: float
    angle: float
    cos: float
    sin: float


class Velocity(Record):
    """A body's velocity: m/s, m/s and rad/s."""

    x: float
    z: float
    angular: float


class Load(Record):
    """Force on a body through its centre of gravity (N) and torque about it (N·m)."""

    x: float
    z: float
    torque: float


class OutlinePiece(Record):
    """The leg's surface on one body: what obstacles meet.

    Parameters
    ----------
    body : Body
    top, bottom : float
        Its ends above the body's centre of gravity, m.
    face : float
        Distance of the surface from the axis, m.
    width : float
        Contact width, m.
    """

    body: int
    top: float
    bottom: float
    face: float
    width: float


class CurvePoint(Record):
    """A point of a piecewise-linear curve: force over shortening, or over time."""

    x: float
    force: float


class Totals(Record):
    """What a law sums up over its rows in a step.

    Parameters
    ----------
    stored : float
        Elastic (or gravitational) energy now, J.
    power : float
        Power being dissipated now, W; negative: work done on the leg from outside.
    dissipated : float
        Energy dissipated so far in sudden amounts (plastic crush, slip), J. It alone is kept from step to
        step.
    force : float
        Resultant along x now, N, positive towards the obstacle.
    penetration : float
        Deepest penetration of a contact now, m.
    flesh_depth : float
        Largest depth of compressed flesh over its thickness now.
    """

    stored: float
    power: float
    dissipated: float
    force: float
    penetration: float
    flesh_depth: float


class Instant(NamedTuple):
    """What all laws see of a step: the instant at which its forces act.

    Parameters
    ----------
    pose : shape (bodies + 1,)
        The last row is the ground.
    velocity : shape (bodies + 1,)
        Velocities extrapolated to that instant, for damping.
    step_velocity : shape (bodies + 1,)
        Velocities over the step that leads there: `step_velocity · step` is the exact displacement, for slip.
    outline : shape (m,)
        The leg's surface, from top to bottom.
    curves : shape (k,)
        Points of all piecewise-linear curves, one curve after another.
    time, step : float
        Seconds; `step` is the length of the step that leads to this instant.
    """

    pose: Rows[Pose]
    velocity: Rows[Velocity]
    step_velocity: Rows[Velocity]
    outline: Rows[OutlinePiece]
    curves: Rows[CurvePoint]
    time: float
    step: float


class ForceLaw(Record):
    """Base of the force laws; an instance is one row of the law's table.

    The function `forces(rows, now, load, totals)` is called once a step. It adds to the bodies' `load`
    (shape (bodies + 1,)), to its own `totals`, and writes the `State` fields of its rows.
    """

    forces: ClassVar[Any]

    @classmethod
    def words(cls) -> str:
        """Return the law's name in the energy balance: `LigamentCable` is the `ligament cable`."""
        return re.sub(r"(?<!^)(?=[A-Z])", " ", cls.__name__).lower()
