"""A planar world as flat arrays, and the builder that assembles it. Knows neither legs nor rigs."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import RunError
from certkit.mechanics.force_laws import LAWS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from certkit.mechanics.force_laws.law import Floats, Integers

GROUND = -1
"""Stands for the ground wherever a body is named."""


@dataclass(frozen=True)
class World:
    """Bodies, pivots and force-law tables, ready for the time loop. Lengths in m, everything SI.

    Parameters
    ----------
    names : tuple of str
        One a body.
    mass, inertia, guided, drag : ndarray, shape (n,)
        Inertia 0 stands for a point mass; a guided body moves along x only; drag is mass damping in 1/s.
    pose, speed : ndarray, shape (n, 3)
        x, z, angle at time zero, and their rates.
    pivot, anchor : ndarray, shape (m, 2) and (m, 4)
        Bodies that share a point (n: the ground), and that point in each body's frame.
    outline_body, outline : ndarray
        See `certkit.mechanics.force_laws.law.Scene`.
    layout, index, number, state : ndarray
        Tables of all laws in pools; see `certkit.mechanics.solver.kernel.table`.
    gravity : ndarray, shape (2,)
    schedule : ndarray, shape (k, 2)
        Time and force of the loading ram.
    hinge : int
        Pivot whose force is recorded, -1 for none.
    """

    names: tuple[str, ...]
    mass: Floats
    inertia: Floats
    guided: Floats
    drag: Floats
    pose: Floats
    speed: Floats
    pivot: Integers
    anchor: Floats
    outline_body: Integers
    outline: Floats
    layout: Integers
    index: Integers
    number: Floats
    state: Floats
    gravity: Floats
    schedule: Floats
    hinge: int

    def body(self, name: str) -> int:
        """Return the number of a body by its name."""
        return self.names.index(name)

    def place(self, law: int, row: int, reading: str) -> int:
        """Return where a row's reading stands in the state pool."""
        columns = LAWS[law].states
        return int(self.layout[law, 5]) + row * len(columns) + columns.index(reading)


@dataclass
class Assembly:
    """Collects bodies, pivots and law rows, then turns them into a `World`."""

    gravity: tuple[float, float] = (0.0, 0.0)
    schedule: Sequence[tuple[float, float]] = ((0.0, 0.0),)
    hinge: int = -1
    _names: list[str] = field(default_factory=list)
    _bodies: list[tuple[float, float, float, float]] = field(default_factory=list)
    _pose: list[tuple[float, float, float]] = field(default_factory=list)
    _speed: list[tuple[float, float, float]] = field(default_factory=list)
    _pivots: list[tuple[int, int, float, float, float, float]] = field(default_factory=list)
    _outline: list[tuple[int, float, float, float, float]] = field(default_factory=list)
    _rows: list[list[tuple[tuple[int, ...], tuple[float, ...]]]] = field(
        default_factory=lambda: [[] for _ in LAWS]
    )

    _memory: list[tuple[int, int, dict[str, float]]] = field(default_factory=list)

    def add_body(  # a body has that many properties
        self,
        name: str,
        mass: float,
        inertia: float,
        pose: tuple[float, float, float],
        *,
        speed: tuple[float, float, float] = (0.0, 0.0, 0.0),
        guided: bool = False,
        drag: float = 0.0,
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
        self._bodies.append((mass, inertia, float(guided), drag))
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
        self._pivots.append((a, b, *self.local(a, x, z), *self.local(b, x, z)))
        return len(self._pivots) - 1

    def add_row(self, law: int, bodies: tuple[int, ...], numbers: Mapping[str, float]) -> int:
        """Add a row to a law's table, its constants by the names of its columns; return the row's number."""
        columns = LAWS[law]
        if set(numbers) != set(columns.numbers) or len(bodies) != len(columns.bodies):
            raise ValueError(f"`{columns.name}` takes bodies {columns.bodies} and numbers {columns.numbers}")
        self._rows[law].append((bodies, tuple(float(numbers[name]) for name in columns.numbers)))
        return len(self._rows[law]) - 1

    def remember(self, law: int, row: int, states: Mapping[str, float]) -> None:
        """Let a row start with something in its state."""
        self._memory.append((law, row, dict(states)))

    def rows(self, law: int) -> int:
        """Return how many rows a law has so far."""
        return len(self._rows[law])

    def add_outline(self, body: int, top: float, bottom: float, face: float, width: float) -> None:
        """Add a piece of the leg's outline, from top to bottom; heights from the body's centre of gravity."""
        self._outline.append((body, top, bottom, face, width))

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
        """Return mass, x, z and inertia of all bodies so far, shape (n, 4)."""
        return np.array(
            [(b[0], p[0], p[1], b[1]) for b, p in zip(self._bodies, self._pose, strict=True)],
            dtype=np.float64,
        ).reshape(-1, 4)

    def finish(self) -> World:
        """Return the world."""
        bodies = np.array(self._bodies, dtype=np.float64).reshape(-1, 4)
        ground = len(self._names)
        layout = np.zeros((len(LAWS), 7), dtype=np.int64)
        index: list[int] = []
        number: list[float] = []
        states = 0
        for number_of_law, law in enumerate(LAWS):
            n = len(self._rows[number_of_law])
            layout[number_of_law] = (
                n,
                len(index),
                len(law.bodies),
                len(number),
                len(law.numbers),
                states,
                len(law.states),
            )
            states += n * len(law.states)
            for who, constants in self._rows[number_of_law]:
                index.extend(ground if b == GROUND else b for b in who)
                number.extend(constants)
        pivots = [(ground if a == GROUND else a, ground if b == GROUND else b) for a, b, *_ in self._pivots]
        state = np.zeros(states)
        for which, at, memory in self._memory:
            names = LAWS[which].states
            for name, value in memory.items():
                state[layout[which, 5] + at * len(names) + names.index(name)] = value
        return World(
            names=tuple(self._names),
            mass=bodies[:, 0].copy(),
            inertia=bodies[:, 1].copy(),
            guided=bodies[:, 2].copy(),
            drag=bodies[:, 3].copy(),
            pose=np.array(self._pose, dtype=np.float64).reshape(-1, 3),
            speed=np.array(self._speed, dtype=np.float64).reshape(-1, 3),
            pivot=np.array(pivots, dtype=np.int64).reshape(-1, 2),
            anchor=np.array([p[2:] for p in self._pivots], dtype=np.float64).reshape(-1, 4),
            outline_body=np.array([o[0] for o in self._outline], dtype=np.int64),
            outline=np.array([o[1:] for o in self._outline], dtype=np.float64).reshape(-1, 4),
            layout=layout,
            index=np.array(index, dtype=np.int64),
            number=np.array(number, dtype=np.float64),
            state=state,
            gravity=np.array(self.gravity, dtype=np.float64),
            schedule=np.array(self.schedule, dtype=np.float64).reshape(-1, 2),
            hinge=self.hinge,
        )
