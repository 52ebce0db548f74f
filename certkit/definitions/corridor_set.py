"""Corridor sets: what a value or curve has to stay within, and the limits and scores of vehicle tests."""

from itertools import pairwise
from typing import Annotated, ClassVar, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Section
from certkit.definitions.corridor_entry import CorridorEntry, order_faults
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.polygon import crossing
from certkit.definitions.score import Score
from certkit.definitions.units import alike, dimensions

Point = tuple[str, str]


class ValueWindow(CorridorEntry):
    """A scalar corridor: `lower` ≤ value ≤ `upper`, in the channel's unit; either may be missing."""

    noun: ClassVar[str] = "window"

    lower: str | None = None
    upper: str | None = None
    exclusive: Annotated[bool, Field(description="A value on the limit itself is outside.")] = False
    decimals: Annotated[
        int | None,
        Field(
            ge=0, le=6, description="Values are rounded half up to so many, in the unit of reports, first."
        ),
    ] = None

    @model_validator(mode="after")
    def _has_order(self) -> Self:
        if self.lower is None and self.upper is None:
            raise Faults([((), "has neither `lower` nor `upper`; add at least one, with its unit")])
        if faults := order_faults(("lower", self.lower), ("upper", self.upper)):
            raise Faults(faults)
        return self

    def lines(self) -> dict[str, str]:
        """Return `235 N·m to 272 N·m`, `at most 22 mm`, `below 320 N·m` or `at least 3 mm`."""
        if self.lower is None:
            return {"": f"{'below' if self.exclusive else 'at most'} {self.upper}"}
        if self.upper is None:
            return {"": f"{'above' if self.exclusive else 'at least'} {self.lower}"}
        return {"": f"{self.lower} to {self.upper}"}


class Polygon(CorridorEntry):
    """A closed area in the plane of two channels that a curve must stay inside of; points are (x, y)."""

    noun: ClassVar[str] = "polygon"

    x: Annotated[str, Field(description="Channel of the abscissa.")]
    y: Annotated[str, Field(description="Channel of the ordinate.")]
    points: Annotated[list[Point], Field(min_length=3, max_length=10_000)]

    @model_validator(mode="after")
    def _is_simple(self) -> Self:
        corners, faults = _line(self.points, "points")
        hit = crossing(corners)
        if hit is not None:
            first, second = (index + 1 for index in hit)
            message = (
                f"the side from point {first} meets the side from point {second}; give the corners in turn"
            )
            faults = [(("points", hit[1]), message)]
        if faults:
            raise Faults(faults)
        return self

    def lines(self) -> dict[str, str]:
        """Return what it consists of."""
        return {"": f"polygon of {len(self.points)} points"}


class Band(CorridorEntry):
    """A corridor over time: lower and upper polylines of (time, value)."""

    noun: ClassVar[str] = "band"

    lower: Annotated[list[Point] | None, Field(min_length=2, max_length=10_000)] = None
    upper: Annotated[list[Point] | None, Field(min_length=2, max_length=10_000)] = None

    @model_validator(mode="after")
    def _runs_forward(self) -> Self:
        if self.lower is None and self.upper is None:
            raise Faults([((), "has neither `lower` nor `upper`; add at least one list of (time, value)")])
        faults: list[Fault] = []
        for side, given in (("lower", self.lower), ("upper", self.upper)):
            points = given or []
            line, wrong = _line(points, side)
            if points and "time" not in dimensions(points[0][0]):
                wrong = [((side, 0, 0), f"`{points[0][0]}` is no time; points are pairs (time, value)")]
            faults += wrong
            faults += [
                (
                    (side, i + 1, 0),
                    (
                        "the times of a band have to increase; this one does not"
                        "; put its points in their order"
                    ),
                )
                for i, ((before, _), (after, _)) in enumerate(pairwise(line))
                if not after > before
            ]
        if faults:
            raise Faults(faults)
        return self

    def lines(self) -> dict[str, str]:
        """Return what it consists of."""
        return {
            side: f"line of {len(points)} points"
            for side in ("lower", "upper")
            if (points := getattr(self, side))
        }


class CorridorSet(Section):
    """Corridors of one procedure from one source. Entries inherit the set's `origin` unless they have one.

    `awaited` names corridors that exist but that nobody could supply yet, with the reason: criteria that are
    held against them are informative until a set of the same name, found earlier, has them.
    """

    corridors: Annotated[str, Field(description="Name of the set.")]
    title: str
    impactor: Annotated[
        str | None, Field(description="The impactor they are for; that of the shipped legform when missing.")
    ] = None
    windows: dict[str, ValueWindow] = {}
    polygons: dict[str, Polygon] = {}
    bands: dict[str, Band] = {}
    scores: dict[str, Score] = {}
    awaited: Annotated[dict[str, str], Field(description="Name: why it is not here yet.")] = {}
    notes: list[str] = []

    @model_validator(mode="after")
    def _has_entries(self) -> Self:
        groups = {name: getattr(self, name) for name in ("windows", "polygons", "bands", "scores", "awaited")}
        if not any(groups.values()):
            raise Faults(
                [((), "holds no corridor; add `windows`, `polygons`, `bands`, `scores` or `awaited`")]
            )
        first: dict[str, str] = {}
        faults: list[Fault] = []
        for group, entries in groups.items():
            for name in entries:
                if first.setdefault(name, group) != group:
                    message = f"`{name}` stands under `{first[name]}` already; names are unique in a set"
                    faults.append(((group, name), message))
        if faults:
            raise Faults(faults)
        return self

    def entry(self, name: str) -> ValueWindow | Polygon | Band | None:
        """Return the corridor of that name; None where it is awaited.

        Raises
        ------
        KeyError
            When the set does not know the name.
        """
        if name in self.awaited:
            return None
        if name in self.windows:
            return self.windows[name]
        if name in self.polygons:
            return self.polygons[name]
        return self.bands[name]

    @property
    def entries(self) -> list[str]:
        """Names of all corridors, also of the awaited ones, without the scores."""
        return [*self.windows, *self.polygons, *self.bands, *self.awaited]


def _line(points: list[Point], key: str) -> tuple[list[tuple[float, float]], list[Fault]]:
    """Return the points as SI numbers, and what is wrong with them; points only when nothing is."""
    (x, x_wrong), (y, y_wrong) = (alike([point[axis] for point in points]) for axis in (0, 1))
    faults: list[Fault] = [((key, index, 0), said) for index, said in x_wrong]
    faults += [((key, index, 1), said) for index, said in y_wrong]
    return ([] if faults else list(zip(x, y, strict=True))), faults
