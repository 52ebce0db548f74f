"""A planar world as tables, and the builder that assembles it. Knows neither legs nor rigs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct, field

from certkit.definitions.fixtures.rig_builder import GROUND
from certkit.errors import RunError
from certkit.mechanics.force_laws import LAWS
from certkit.mechanics.force_laws.law import CurvePoint, ForceLaw, OutlinePiece
from certkit.mechanics.records import WORD, Record, body_fields, record_type, table_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from certkit.mechanics.records import Floats, Structured


class Pivot(Record):
    """A point that two bodies share, in each body's frame from its centre of gravity, m."""

    first: int
    second: int
    first_x: float
    first_z: float
    second_x: float
    second_z: float


class LawTable(Record):
    """Where a law's table stands in a world's `tables`: number of rows, and place of the first."""

    rows: int
    start: int


class World(Struct, frozen=True):
    """Bodies, pivots and force-law tables, ready for the time loop. Lengths in m, everything SI.

    Parameters
    ----------
    names : tuple of str
        One a body.
    mass, inertia, guided, damping : ndarray, shape (n,)
        Inertia 0 stands for a point mass; a guided body moves along x only; damping is mass damping in 1/s.
    pose, speed : ndarray, shape (n, 3)
        x, z, angle at time zero, and their rates.
    pivots : ndarray of Pivot, shape (m,)
        Body n is the ground.
    outline : ndarray of OutlinePiece, shape (p,)
        The leg's surface, from top to bottom.
    curves : ndarray of CurvePoint, shape (c,)
        Points of all piecewise-linear curves that laws refer to.
    layout : ndarray of LawTable, shape (laws,)
    tables : ndarray, shape (t,)
        Tables of all laws, one after another, as plain numbers: see `table`.
    gravity : ndarray, shape (2,)
    hinge : int
        Pivot whose force is recorded, -1 for none.
    """

    names: tuple[str, ...]
    mass: Floats
    inertia: Floats
    guided: Floats
    damping: Floats
    pose: Floats
    speed: Floats
    pivots: Structured
    outline: Structured
    curves: Structured
    layout: Structured
    tables: Floats
    gravity: Floats
    hinge: int

    def body(self, name: str) -> int:
        """Return the number of a body by its name."""
        return self.names.index(name)

    def table(self, law: type[ForceLaw]) -> Structured:
        """Return a law's table, shape (rows,): a view, which writes through to `tables`."""
        rows, start = self.layout[LAWS.index(law)].tolist()
        kind = record_type(law)
        return self.tables[start : start + rows * kind.itemsize // WORD].view(kind)

    def place(self, law: type[ForceLaw], row: int, state: str) -> int:
        """Return where a state of a law's row stands in `tables`, to record it."""
        kind = record_type(law)
        names = kind.names or ()
        return int(self.layout[LAWS.index(law)]["start"]) + row * len(names) + names.index(state)


class Assembly(Struct):
    """Collects bodies, pivots and law rows, then turns them into a `World`."""

    gravity: tuple[float, float] = (0.0, 0.0)
    hinge: int = -1
    _names: list[str] = field(default_factory=list)
    _bodies: list[tuple[float, float, float, float]] = field(default_factory=list)
    _pose: list[tuple[float, float, float]] = field(default_factory=list)
    _speed: list[tuple[float, float, float]] = field(default_factory=list)
    _pivots: list[Pivot] = field(default_factory=list)
    _outline: list[OutlinePiece] = field(default_factory=list)
    _curves: list[CurvePoint] = field(default_factory=list)
    _rows: dict[type[ForceLaw], list[ForceLaw]] = field(default_factory=lambda: {law: [] for law in LAWS})

    def add_body(  # a body has that many properties
        self,
        name: str,
        mass: float,
        inertia: float,
        pose: tuple[float, float, float],
        *,
        speed: tuple[float, float, float] = (0.0, 0.0, 0.0),
        guided: bool = False,
        damping: float = 0.0,
    ) -> int:
        """Add a body and return its number. Inertia 0 makes a point mass.

        Raises
        ------
        RunError
            When it has no mass, or its inertia is negative: Munk2D would end the process.
        """
        if name in self._names:
            raise ValueError(f"there is a body `{name}` already")
        if not (0 < mass < math.inf and 0 <= inertia < math.inf):
            raise RunError(
                f"the {name} cannot move with a mass of {mass:g} kg and an inertia of {inertia:g} kg·m²; "
                "check its mass and lengths"
            )
        self._names.append(name)
        self._bodies.append((mass, inertia, float(guided), damping))
        self._pose.append(pose)
        self._speed.append(speed)
        return len(self._names) - 1

    def centre(self, body: int) -> tuple[float, float]:
        """Return where a body's centre of gravity is placed."""
        return (0.0, 0.0) if body == GROUND else self._pose[body][:2]

    def local(self, body: int, x: float, z: float) -> tuple[float, float]:
        """Return a point of space in a body's own frame."""
        if body == GROUND:
            return x, z
        bx, bz, angle = self._pose[body]
        c, s = math.cos(angle), math.sin(angle)
        return c * (x - bx) + s * (z - bz), c * (z - bz) - s * (x - bx)

    def add_pivot(self, a: int, b: int, x: float, z: float) -> int:
        """Pin two bodies together at a point of space; return the pivot's number."""
        self._pivots.append(Pivot(a, b, *self.local(a, x, z), *self.local(b, x, z)))
        return len(self._pivots) - 1

    def add(self, row: ForceLaw) -> int:
        """Add a row to its law's table; return the row's number."""
        rows = self._rows[type(row)]
        rows.append(row)
        return len(rows) - 1

    def add_curve(self, points: Sequence[tuple[float, float]]) -> tuple[int, int]:
        """Add a piecewise-linear curve for a law to refer to; return its first point and their number."""
        self._curves.extend(CurvePoint(x, force) for x, force in points)
        return len(self._curves) - len(points), len(points)

    def add_outline(self, piece: OutlinePiece) -> None:
        """Add a piece of the leg's surface, from top to bottom."""
        self._outline.append(piece)

    def turn(self, angle: float, x: float, z: float) -> None:
        """Turn everything placed so far about a point of space."""
        c, s = math.cos(angle), math.sin(angle)
        self._pose = [
            (x + c * (px - x) - s * (pz - z), z + s * (px - x) + c * (pz - z), a + angle)
            for px, pz, a in self._pose
        ]

    def spin(self, rate: float, x: float, z: float) -> None:
        """Give everything placed so far the speed of a turn about a point of space."""
        self._speed = [(-rate * (pz - z), rate * (px - x), rate) for px, pz, _ in self._pose]

    def throw(self, x: float, z: float) -> None:
        """Give everything placed so far one speed."""
        self._speed = [(x, z, 0.0)] * len(self._speed)

    def masses(self) -> NDArray[np.float64]:
        """Return mass (kg), x, z (m) and inertia (kg·m²) of all bodies so far, shape (n, 4)."""
        return np.array(
            [(b[0], p[0], p[1], b[1]) for b, p in zip(self._bodies, self._pose, strict=True)],
            dtype=np.float64,
        ).reshape(-1, 4)

    def finish(self) -> World:
        """Return the world."""
        ground = len(self._names)
        layout, pools, start = [], [np.zeros(0)], 0
        for law, rows in self._rows.items():
            table = _grounded(table_of(law, rows), body_fields(law), ground)
            layout.append(LawTable(len(rows), start))
            pools.append(table.view(np.float64))
            start += pools[-1].size
        bodies = np.array(self._bodies, dtype=np.float64).reshape(-1, 4)
        return World(
            names=tuple(self._names),
            mass=bodies[:, 0].copy(),
            inertia=bodies[:, 1].copy(),
            guided=bodies[:, 2].copy(),
            damping=bodies[:, 3].copy(),
            pose=np.array(self._pose, dtype=np.float64).reshape(-1, 3),
            speed=np.array(self._speed, dtype=np.float64).reshape(-1, 3),
            pivots=_grounded(table_of(Pivot, self._pivots), ("first", "second"), ground),
            outline=table_of(OutlinePiece, self._outline),
            curves=table_of(CurvePoint, self._curves),
            layout=table_of(LawTable, layout),
            tables=np.concatenate(pools),
            gravity=np.array(self.gravity, dtype=np.float64),
            hinge=self.hinge,
        )


def _grounded(table: Structured, names: Sequence[str], ground: int) -> Structured:
    """Write the ground's number where it is named."""
    for name in names:
        table[name][table[name] == GROUND] = ground
    return table
