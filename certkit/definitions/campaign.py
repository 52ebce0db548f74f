"""The campaign: a car, its impact points, the sources of their values, and the schemes that judge it."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from certkit.definitions.base import Document
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import dimensions, parse_quantity

SourceKind = Literal["measured", "finite elements", "lumped", "predicted"]
"""Where a value comes from; the first of these that a point has decides."""

RANK: tuple[SourceKind, ...] = ("measured", "finite elements", "lumped", "predicted")


def _quantity(dimension: str) -> AfterValidator:
    def check(text: str) -> str:
        parse_quantity(text, dimension)
        return text

    return AfterValidator(check)


LengthText = Annotated[str, _quantity("length")]
AngleText = Annotated[str, _quantity("angle")]
ShareText = Annotated[str, _quantity("ratio")]
Quantities = Annotated[dict[str, str], Field(min_length=1, description="By criterion id: `T1: 256 N·m`.")]


class PointSource(Document):
    """One source of a point's values: exactly one of the first four keys."""

    measured: Annotated[
        str | None, Field(description="Recording, `result.json` or run folder of a laboratory's test.")
    ] = None
    finite_elements: Annotated[
        str | None, Field(description="Likewise of a finite-element run: a file that `certkit grade` takes.")
    ] = None
    lumped: Annotated[str | None, Field(description="Procedure that is simulated here.")] = None
    predicted: Annotated[Quantities | None, Field(description="Values that the maker names.")] = None
    procedure: Annotated[
        str | None, Field(description="That a recording is graded by; the campaign's when missing.")
    ] = None
    mapping: Annotated[str | None, Field(description="Mapping file of a recording.")] = None
    laboratory: Annotated[str | None, Field(description="`lab.yaml` of a measured one.")] = None
    set: Annotated[dict[str, str | float], Field(description="Values changed in a simulation, by path.")] = {}
    by: Annotated[str | None, Field(description="Who says so, or where it comes from.")] = None

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        ways = (self.measured, self.finite_elements, self.lumped, self.predicted)
        if sum(way is not None for way in ways) != 1:
            raise Faults([((), "a source is one of `measured`, `finite elements`, `lumped`, `predicted`")])
        faults: list[Fault] = [
            (
                ("predicted", name),
                f"`{text}` is not a number with a unit that certkit knows; write it like `700 mm`",
            )
            for name, text in (self.predicted or {}).items()
            if not set(dimensions(text)) - {"ratio", "count"}
        ]
        faults += [
            (("predicted", name), f"`{text}` is negative; limits are held against sizes")
            for name, text in (self.predicted or {}).items()
            if text.lstrip().startswith("-")
        ]
        if self.set and self.lumped is None:
            faults.append(
                (
                    ("set",),
                    (
                        "only a `lumped` source is simulated, so that values can be changed"
                        "; leave the changed values out"
                    ),
                )
            )
        faults += [
            (
                (key,),
                (
                    f"`{key}` belongs to a recording: `measured` or `finite elements`"
                    "; leave it out, or change the kind of the source"
                ),
            )
            for key in ("procedure", "mapping")
            if getattr(self, key) is not None and self.file is None
        ]
        if self.laboratory is not None and self.measured is None:
            faults.append((("laboratory",), "`laboratory` belongs to a `measured` source; leave it out here"))
        if faults:
            raise Faults(faults)
        return self

    @property
    def kind(self) -> SourceKind:
        """Which of the four it is."""
        if self.measured is not None:
            return "measured"
        if self.finite_elements is not None:
            return "finite elements"
        return "lumped" if self.lumped is not None else "predicted"

    @property
    def file(self) -> str | None:
        """The file or folder it is read from, as written."""
        return self.measured if self.measured is not None else self.finite_elements


class ImpactPoint(Document):
    """A place where the leg meets the car."""

    point: Annotated[str, Field(min_length=1, max_length=24, description="Its name, such as `L+2`.")]
    across: Annotated[
        LengthText,
        Field(description="From the car's middle; positive on the right from ahead."),
    ]
    height: Annotated[
        LengthText | None, Field(description="Above the ground; the bumper's when missing.")
    ] = None
    angle: Annotated[
        AngleText, Field(description="Of the velocity to the car's long axis, seen from above.")
    ] = "0 deg"
    column: Annotated[
        int | None,
        Field(ge=-50, le=50, description="Of Euro NCAP's grid, as its workbook counts."),
    ] = None
    sources: Annotated[list[PointSource], Field(max_length=20)] = []

    @property
    def metres(self) -> float:
        """The place across the car, m."""
        return parse_quantity(self.across, "length")


class Replacement(Document):
    """Later runs in the place of what a point had: older values stay visible, and decide no longer."""

    point: str
    sources: Annotated[list[PointSource], Field(min_length=1, max_length=20)]
    reason: Annotated[str, Field(min_length=3)]


class TestedCar(Document):
    """The car as the page draws it; what the schemes need of it is the test area and the symmetry."""

    name: str
    width: LengthText = "1800 mm"
    height: LengthText = "1450 mm"
    bonnet_edge: Annotated[LengthText, Field(description="Height of the bonnet's leading edge.")] = "750 mm"
    bumper: Annotated[LengthText, Field(description="Height of the bumper's middle.")] = "500 mm"
    test_area: Annotated[
        tuple[LengthText, LengthText] | None, Field(description="Where points may lie, across the car.")
    ] = None
    symmetric: Annotated[bool, Field(description="Whether left and right are built alike.")] = False


class Targets(Document):
    """The maker's own targets, as shares of a scheme's limits."""

    of: Annotated[str, Field(description="A scheme of limits.")]
    share: ShareText
    criteria: Annotated[dict[str, ShareText], Field(description="Other shares, by criterion id.")] = {}


class Campaign(Document):
    """A car with its impact points, judged by schemes. Paths are meant from this file's folder."""

    campaign: Annotated[str, Field(description="Its name.")]
    title: str
    car: TestedCar
    procedure: Annotated[str, Field(description="That recordings are graded by.")] = "vehicle"
    schemes: Annotated[list[str], Field(min_length=1, max_length=10, description="The first is drawn large.")]
    relaxed: Annotated[
        list[tuple[LengthText, LengthText]],
        Field(max_length=50, description="Zones across the car that take a scheme's relaxed limits."),
    ] = []
    targets: Targets | None = None
    at_least: Annotated[
        dict[str, float], Field(description="Points that a scheme has to give, by its name: a gate.")
    ] = {}
    agreement: Annotated[
        ShareText | None, Field(description="Measured values may lie so far from predicted ones: a gate.")
    ] = None
    points: Annotated[list[ImpactPoint], Field(min_length=1, max_length=200)]
    replace: Annotated[list[Replacement], Field(max_length=200)] = []
    notes: list[str] = []

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        names = [point.point for point in self.points]
        faults: list[Fault] = [
            (
                ("points", i, "point"),
                f"`{name}` is a point already; names are unique; give this one another",
            )
            for i, name in enumerate(names)
            if name in names[:i]
        ]
        faults += [
            (("replace", i, "point"), f"there is no point `{each.point}`; {suggestion(each.point, names)}")
            for i, each in enumerate(self.replace)
            if each.point not in names
        ]
        again = [each.point for each in self.replace]
        faults += [
            (("replace", i, "point"), f"`{name}` is replaced twice; keep the later one")
            for i, name in enumerate(again)
            if name in again[:i]
        ]
        faults += [
            (("at least", name), f"`{name}` is no scheme of this campaign; {suggestion(name, self.schemes)}")
            for name in self.at_least
            if name not in self.schemes
        ]
        faults += self._places()
        if faults:
            raise Faults(faults)
        return self

    def _places(self) -> list[Fault]:
        faults: list[Fault] = [
            (("relaxed", i), f"the zone ends at {zone[1]}, before it begins at {zone[0]}; exchange the two")
            for i, zone in enumerate(self.zones)
            if zone[0] >= zone[1]
        ]
        ordered = sorted(self.zones)
        faults += [
            (("relaxed",), "two zones overlap; write them as one")
            for (_, end), (start, _) in pairwise(ordered)
            if start < end
        ]
        if self.car.test_area is not None:
            low, high = (parse_quantity(edge, "length") for edge in self.car.test_area)
            faults += [
                (
                    ("points", i, "across"),
                    (
                        f"lies outside the test area, {self.car.test_area[0]} to {self.car.test_area[1]}"
                        "; correct the point or the area"
                    ),
                )
                for i, point in enumerate(self.points)
                if not low - 1e-9 <= point.metres <= high + 1e-9
            ]
        return faults

    @property
    def zones(self) -> list[tuple[float, float]]:
        """The relaxed zones, m."""
        return [(parse_quantity(a, "length"), parse_quantity(b, "length")) for a, b in self.relaxed]
