"""`PartHistories`: what every finite-element reader yields, whatever solver wrote the files. SI units.

Only the direction of the impact is kept (x along the car), because that is the one a lumped front moves in.
"""

from __future__ import annotations

import re
from collections import Counter
from difflib import get_close_matches
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, TypeVar

from msgspec import Struct, field

from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    import numpy as np
    from numpy.typing import NDArray

    Values = NDArray[np.float64]
    Place = tuple[float | None, float | None, float | None]

T = TypeVar("T")


class Units(Struct, frozen=True):
    """Factors from a file's consistent units to SI.

    Parameters
    ----------
    mass, length, time : float
        Kilograms, metres and seconds in one unit of the file.
    """

    mass: float
    length: float
    time: float

    @property
    def momentum(self) -> float:
        """Newton seconds in one unit of momentum or impulse."""
        return self.mass * self.length / self.time

    @property
    def force(self) -> float:
        """Newtons in one unit of force."""
        return self.momentum / self.time

    @property
    def energy(self) -> float:
        """Joules in one unit of energy."""
        return self.force * self.length


_MASSES = {"kg": 1.0, "g": 1e-3, "t": 1e3}
_LENGTHS = {"mm": 1e-3, "m": 1.0}
_TIMES = {"ms": 1e-3, "s": 1.0}


def parse_units(words: str) -> Units:
    """Read `kg mm ms` as a consistent set of units.

    Raises
    ------
    DataError
        When it is not a mass, a length and a time that are known.
    """
    parts = re.split(r"[\s,]+", words.strip())
    if len(parts) == 3:
        mass, length, time = parts
        if mass in _MASSES and length in _LENGTHS and time in _TIMES:
            return Units(_MASSES[mass], _LENGTHS[length], _TIMES[time])
    raise DataError(
        f"units `{words}` are not known; write mass, length and time such as `kg mm ms`, `t mm s` or `kg m s`"
    )


class PartHistory(Struct, frozen=True):
    """One part (or rigid body) of the finite-element model.

    Parameters
    ----------
    mass : float or None
        Initial mass in kg; None where no file tells it.
    momentum : ndarray, shape (n,), or None
        Momentum along x in N·s.
    displacement : ndarray, shape (n,), or None
        Displacement of the centre of gravity along x in m.
    front : ndarray, shape (n,), or None
        Mean displacement of the part's front along x in m.
    id : int or None
        Its number in the model; None where the file has none.
    velocity : ndarray, shape (n,), or None
        Of the centre of gravity along x in m/s, where a file has that and no momentum.
    start : tuple or None
        (x, y, z) of its centre at the start in m, a coordinate that is not known None; None where none is.
    """

    mass: float | None = None
    momentum: Values | None = None
    displacement: Values | None = None
    front: Values | None = None
    id: int | None = None
    velocity: Values | None = None
    start: Place | None = None


class ContactHistory(Struct, frozen=True):
    """What one contact interface has passed on along x: impulse in N·s and, where recorded, force in N."""

    impulse: Values
    force: Values | None = None


class SpringHistory(Struct, frozen=True):
    """A discrete spring to the ground: force on the ground in N and shortening in m, both positive in +x."""

    force: Values
    shortening: Values | None = None


class PartHistories(Struct, frozen=True):
    """All histories of one finite-element run on the solver's own, slightly uneven time axis.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Seconds, strictly increasing.
    parts, nodes, contacts, springs, energies : mapping
        By the name in the model. Node values are displacements along x in m, energies in J.
    node_places : mapping
        (x, y, z) of nodes at the start in m, as far as the file tells them.
    leg : mapping
        Moments (N·m) and elongations (m) of the leg by channel: T1, MCL …; only looked at to judge.
    notes : tuple of str
        What the reader had to assume or repair.
    files : mapping of str to str
        SHA-256 of every file that was read, by its name.
    """

    time: Values
    parts: Mapping[str, PartHistory]
    nodes: Mapping[str, Values] = field(default_factory=dict)
    contacts: Mapping[str, ContactHistory] = field(default_factory=dict)
    springs: Mapping[str, SpringHistory] = field(default_factory=dict)
    energies: Mapping[str, Values] = field(default_factory=dict)
    leg: Mapping[str, Values] = field(default_factory=dict)
    node_places: Mapping[str, Place] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    source: str = ""
    files: Mapping[str, str] = field(default_factory=dict)

    def part(self, pattern: str) -> PartHistory:
        """Return the part of that name or glob pattern; DataError when there is none or more than one."""
        return self.parts[match_one(pattern, self.parts, "part", self.source)]

    def node(self, pattern: str) -> Values:
        """Return the x displacement (m), shape (n,), of the node of that name or glob pattern."""
        return self.nodes[match_one(pattern, self.nodes, "node", self.source)]

    def contact(self, pattern: str) -> ContactHistory:
        """Return the contact interface of that name or glob pattern."""
        return self.contacts[match_one(pattern, self.contacts, "contact", self.source)]

    def spring(self, pattern: str) -> SpringHistory:
        """Return the spring of that name or glob pattern."""
        return self.springs[match_one(pattern, self.springs, "spring", self.source)]


def distinct(objects: Iterable[tuple[int, str]]) -> dict[int, str]:
    """Return a name by id: the title, with the id behind it where several objects have the same."""
    titles = dict(objects)
    counts = Counter(titles.values())
    return {
        number: title if counts[title] == 1 else f"{title} (id {number})" for number, title in titles.items()
    }


def match_one(pattern: str, names: Mapping[str, T], kind: str, source: str) -> str:
    """Find the one name that a pattern such as `F1_*` means.

    Raises
    ------
    DataError
        When nothing or more than one thing matches; names what there is.
    """
    if pattern in names:
        return pattern
    twins = [name for name in names if name.startswith(f"{pattern} (id ")]
    if twins:
        raise DataError(
            f"{source}: `{pattern}` is the title of {len(twins)} {kind}s; name each that is meant: "
            f"{', '.join(twins[:6])}"
        )
    found = [name for name in names if fnmatchcase(name, pattern)]
    if len(found) == 1:
        return found[0]
    if found:
        raise DataError(
            f"{source}: `{pattern}` fits {len(found)} {kind}s ({', '.join(found[:6])}); name one of them, "
            "or list all that are meant"
        )
    near = get_close_matches(pattern, names, n=1)
    if near:
        hint = f"did you mean `{near[0]}`?"
    elif names:
        hint = f"there are {', '.join(list(names)[:12])}"
    else:
        hint = f"the file holds no {kind}s; ask the solver to write them"
    raise DataError(f"{source}: no {kind} `{pattern}`; {hint}")
