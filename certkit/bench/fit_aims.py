"""What a fit aimed at, as far as a result has to say so: its targets, and the bounds of its parameters.

Every run asks for it. Of a fit's file only this is read here, which takes a third of the time of the whole.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, Literal

from msgspec import Struct, ValidationError, convert

from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import find, names
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.errors import CertkitError

if TYPE_CHECKING:
    from certkit.definitions.loading.search_path import Found


class AimedAt(Struct, frozen=True):
    """A procedure, and what its values should come to."""

    procedure: str
    to: Literal["corridors", "reference", "recording"] = "corridors"


class Bounds(Struct, frozen=True):
    """A number that was free between bounds, which are texts, or numbers as they were written."""

    path: str
    lower: object
    upper: object
    procedure: str | None = None
    """None where it is of the legform."""


class FitAims(Struct, frozen=True):
    """A fit of a legform; see `certkit.definitions.calibration.CalibrationTask`."""

    fit: str
    legform: str
    targets: list[AimedAt]
    parameters: list[Bounds]


@cache
def known_fits(library: tuple[str, ...]) -> tuple[FitAims, ...]:
    """Return what all fits of a library aimed at.

    Those that cannot be read are passed over; `certkit validate` says what is wrong with them.
    """
    found = []
    for name in names("fit", library):
        try:
            found.append(convert(_data(find(KINDS["fit"], name, library)), FitAims))
        except (CertkitError, ValidationError):
            continue
    return tuple(found)


@cache
def corridor_sets(procedure: str, library: tuple[str, ...]) -> frozenset[str]:
    """Return the names of the corridor sets that a procedure grades by; none where it cannot be read."""
    try:
        data = _data(find(KINDS["procedure"], procedure, library))
        return frozenset(convert(data, _Graded).sets())
    except (CertkitError, ValidationError):
        return frozenset()


class _Criterion(Struct):
    """Of a procedure's criterion, what it is held against: `set/entry`."""

    corridor: str | None = None


class _Graded(Struct):
    """Of a procedure, its criteria."""

    criteria: list[_Criterion] = []

    def sets(self) -> set[str]:
        """Return the names of the sets."""
        return {each.corridor.partition("/")[0] for each in self.criteria if each.corridor}


def _data(found: Found) -> dict[str, Any]:
    return read_tree(found.data, found.file).data
