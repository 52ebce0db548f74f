"""The vehicle document: a front of lumped groups, the springs between them and the ground."""

from __future__ import annotations

from itertools import combinations
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Section
from certkit.definitions.bounded_numbers import LengthFromZero, RatioFromZero, StiffnessAboveZero
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.provenance import Damping, Force, Length, Mass, Ratio, Stiffness

SHARED = 0.01
"""m of height that two faces may share, as ends of one line that were rounded."""


class FaceOutline(Section):
    """The line of a face while it is pushed in: points [x, height above the ground]."""

    at: Annotated[Length, Field(description="Displacement of the group.")]
    points: Annotated[list[tuple[Length, Length]], Field(min_length=2, max_length=200)]


class ReturningOutline(Section):
    """The line of a face while it comes back from its largest displacement, the one of the last outline."""

    share: Annotated[Ratio, Field(description="Displacement of the group over its largest.")]
    points: Annotated[list[tuple[Length, Length]], Field(min_length=2, max_length=200)]


class Group(Section):
    """A lumped part of the front. Heights are above the ground; x grows into the car.

    A face is flat (`low`, `high`, `position`, `slope`) and moves as a whole with its group, or it has
    `outlines`: where each of its points stands at several displacements of the group while it is pushed in,
    and `springing back`, with the largest displacement of `outlines`, while it comes back. Where the last
    point of a face is the first of another, it belongs to that other: a load between two points is on each in
    the measure of how near it is.
    """

    kind: Annotated[
        Literal["fascia", "hood", "engine room"],
        Field(description="`hood` is the bonnet; its lowest group is the bonnet leading edge."),
    ]
    mass: Mass
    position: Annotated[
        Length | None, Field(description="x of the face at the middle of its height span.")
    ] = None
    low: Annotated[
        LengthFromZero | None, Field(description="Lower end of the face; none: never touched.")
    ] = None
    high: Annotated[Length | None, Field(description="Upper end of the face.")] = None
    slope: Annotated[Ratio | None, Field(description="dx/dz of the face.")] = None
    room: Annotated[
        Length | None,
        Field(description="Free travel behind it, up to what is no part of the front; beyond is an error."),
    ] = None
    outlines: Annotated[list[FaceOutline], Field(max_length=100)] = []
    springing_back: Annotated[list[ReturningOutline], Field(max_length=100)] = []

    @model_validator(mode="after")
    def _whole(self) -> Self:
        faults: list[Fault] = []
        given = [value is not None for value in (self.low, self.high, self.position)]
        if any(given) and not all(given):
            faults.append(((), "a face has low, high and position; give all three, or none"))
        if self.low is not None and self.high is not None and self.high <= self.low:
            faults.append((("high",), "`high` is not above `low`; swap them"))
        if self.room is not None and self.room <= 0:
            faults.append((("room",), "no room, no travel: leave `room` out, or give a length"))
        if self.springing_back and not self.outlines:
            faults.append((("springing back",), "a face that springs back needs `outlines` first"))
        for name, places, lines in (
            ("outlines", [float(o.at) for o in self.outlines], [o.points for o in self.outlines]),
            (
                "springing back",
                [float(o.share) for o in self.springing_back],
                [o.points for o in self.springing_back],
            ),
        ):
            for k, points in enumerate(lines):
                if self.outlines and len(points) != len(self.outlines[0].points):
                    faults.append(
                        ((name, k, "points"), "every outline of a face has the same points; resample them")
                    )
                if k > 0 and places[k] <= places[k - 1]:
                    faults.append(
                        ((name, k), "outlines have to stand in rising order; put them in their order")
                    )
        if faults:
            raise Faults(faults)
        return self


class Bottoming(Section):
    """The end of a spring's travel: beyond `at` it is stiffer by `stiffness`."""

    at: LengthFromZero
    stiffness: Stiffness


class Spring(Section):
    """What lies between two groups, or between a group and the ground: a spring law and a damper.

    Loading is piecewise linear through `loading` (shortening, force), continued with its last slope, and
    with `bottoming` beyond its travel. From the largest shortening x and force F so far, unloading and
    reloading run down with the `unloading` stiffness to the line from `permanent set`·x to `residual`·F,
    then along it; never below zero. Points at negative shortenings are the pulling side of a spring with
    `tension`.
    """

    between: Annotated[
        list[str], Field(min_length=2, max_length=2, description="`ground` is the car's body.")
    ]
    loading: Annotated[list[tuple[Length, Force]], Field(min_length=2, max_length=500)]
    unloading: StiffnessAboveZero | None = None
    residual: Annotated[
        Ratio | None, Field(description="Share of the largest force that stays; 0 when missing.")
    ] = None
    permanent_set: Annotated[
        Ratio | None, Field(description="Share of the largest shortening that stays.")
    ] = None
    damping: Damping | None = None
    gap: Annotated[LengthFromZero | None, Field(description="Free travel before the spring acts.")] = None
    tension: Annotated[bool, Field(description="Whether the spring also pulls.")] = False
    bottoming: Bottoming | None = None
    seen: Annotated[
        LengthFromZero | None,
        Field(
            description="Largest shortening that the curve was read from; a run beyond it is remarked upon."
        ),
    ] = None

    @model_validator(mode="after")
    def _possible(self) -> Self:
        faults: list[Fault] = []
        for index, ((x, force), (before, _)) in enumerate(
            zip(self.loading[1:], self.loading, strict=False), 1
        ):
            if x <= before:
                faults.append(
                    (
                        ("loading", index),
                        (
                            "the curve's shortenings have to rise from point to point"
                            "; put the points in their order"
                        ),
                    )
                )
            if x > 0 > force:
                faults.append(
                    (
                        ("loading", index),
                        "the spring pulls where it is pressed; give it a force of zero or above",
                    )
                )
        for name, share in (("residual", self.residual), ("permanent set", self.permanent_set)):
            if share is not None and not 0 <= share < 1:
                faults.append(((name,), "a share lies between 0 and 1"))
        if faults:
            raise Faults(faults)
        return self


class FrontSheet(Section):
    """What a folding sheet passes on between two neighbouring groups; it pushes and pulls.

    Its force is no function of the shortening alone. Along the path of the recorded run both follow the
    progress, the mean displacement of the two groups: `path` holds [progress, shortening, force] while they
    are pushed in, `springing back` [share of the largest progress, shortening, force] that the way back adds
    to the values at the largest progress. Off that path `stiffness` and `damping` act. Without `tension` it
    is a contact that slides along the sheet: it only pushes, and off its path is as stiff as it is loaded.
    """

    between: Annotated[list[str], Field(min_length=2, max_length=2)]
    path: Annotated[list[tuple[Length, Length, Force]], Field(min_length=2, max_length=500)]
    springing_back: Annotated[list[tuple[Ratio, Length, Force]], Field(max_length=500)] = []
    stiffness: Stiffness
    damping: Damping
    tension: Annotated[bool, Field(description="Whether it also pulls.")] = True

    @model_validator(mode="after")
    def _rising(self) -> Self:
        faults: list[Fault] = []
        for name, places in (
            ("path", [float(p[0]) for p in self.path]),
            ("springing back", [float(p[0]) for p in self.springing_back]),
        ):
            faults += [
                (
                    (name, k),
                    "the first numbers have to rise from point to point; put the points in their order",
                )
                for k in range(1, len(places))
                if places[k] <= places[k - 1]
            ]
        if not self.tension and self.largest_force <= 0:
            faults.append((("path",), "a contact that never pushes; leave it out, or give its forces"))
        if faults:
            raise Faults(faults)
        return self

    @property
    def largest_force(self) -> float:
        """Return the largest force of both ways, N."""
        end = float(self.path[-1][2])
        return max([float(p[2]) for p in self.path] + [end + float(p[2]) for p in self.springing_back])


class Vehicle(Section):
    """A car front as the leg meets it."""

    vehicle: Annotated[str, Field(description="Its name.")]
    title: str
    groups: Annotated[dict[str, Group], Field(min_length=1, max_length=200)]
    springs: Annotated[dict[str, Spring], Field(min_length=1, max_length=2000, description="By their names.")]
    sheets: Annotated[dict[str, FrontSheet], Field(max_length=2000, description="By their names.")] = {}
    friction: Annotated[RatioFromZero | None, Field(description="Between the leg and the faces.")] = None
    notes: list[str] = []

    @model_validator(mode="after")
    def _held(self) -> Self:
        ends = {end for spring in self.springs.values() for end in spring.between}
        ends |= {end for sheet in self.sheets.values() for end in sheet.between}
        faults: list[Fault] = [
            (("groups", name), f"nothing holds `{name}`; connect it, or leave it out")
            for name in self.groups
            if name not in ends
        ]
        faults += [
            (("sheets", name), "a spring has this name already; give the sheet another")
            for name in self.sheets
            if name in self.springs
        ]
        if all(group.position is None for group in self.groups.values()):
            faults.append(
                (
                    ("groups",),
                    (
                        "no group has a face (low, high, position): there is nothing to hit"
                        "; give one of them a face"
                    ),
                )
            )
        if faults:
            raise Faults(faults)
        return self

    @property
    def shared_heights(self) -> list[tuple[str, str, float]]:
        """Return pairs of flat faces at one height, and what they share of it, m.

        The leg's flesh is one layer, and two such faces press on it as if it were two. Faces with outlines
        stand where a run had them.
        """
        if any(group.outlines for group in self.groups.values()):
            return []
        faced = sorted(
            (float(group.low), float(group.high), name)
            for name, group in self.groups.items()
            if group.low is not None and group.high is not None
        )
        shared = (
            (one, other, min(high, top) - low) for (_, top, one), (low, high, other) in combinations(faced, 2)
        )
        return [each for each in shared if each[2] > SHARED]
