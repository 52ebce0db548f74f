"""Schemes: how a whole car is judged by its impact points, by limits or by points on a sliding scale."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Document, Sourced
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import parse_quantity

Windows = Annotated[
    dict[str, str], Field(min_length=1, description="Window of the corridor set, by criterion id.")
]


class Relaxation(Sourced):
    """Other limits that hold over widths of the bumper which the maker chooses."""

    limits: Windows
    width: Annotated[str, Field(description="Of all such zones together, at most.")]

    @model_validator(mode="after")
    def _is_wide(self) -> Self:
        if parse_quantity(self.width, "length") <= 0:
            raise Faults([(("width",), f"`{self.width}` has to be greater than zero")])
        return self

    @property
    def metres(self) -> float:
        """The width, m."""
        return parse_quantity(self.width, "length")

    def lines(self) -> dict[str, str]:
        """Return its number as people read it."""
        return {"width": self.width}


class Total(Sourced):
    """Points of the whole bumper: so many, times the mean share of its points."""

    points: Annotated[float, Field(gt=0)]

    def lines(self) -> dict[str, str]:
        """Return its number as people read it."""
        return {"points": f"{self.points:g}"}


class UntestedPoints(Sourced):
    """What stands for a point that has no value of its own."""

    mirrored: Annotated[bool, Field(description="The point on the other side of a symmetric car does.")] = (
        False
    )
    neighbours: Annotated[
        Literal["worst", "largest values"] | None,
        Field(
            description="`worst`: the worse of the points beside it does; `largest values`: of "
            "each criterion the larger value of both."
        ),
    ] = None

    def lines(self) -> dict[str, str]:
        """Return its rules as people read them."""
        told = {"mirrored": "yes"} if self.mirrored else {}
        return told | ({"neighbours": self.neighbours} if self.neighbours else {})


class Scheme(Document):
    """How points add up to a judgement of the car: `limits` that each has to keep, or else scores."""

    scheme: Annotated[str, Field(description="Its name.")]
    title: str
    impactor: Annotated[str, Field(description="The legform it is for.")]
    corridors: Annotated[str, Field(description="The corridor set that limits or scores stand in.")]
    limits: Windows | None = None
    relaxation: Relaxation | None = None
    total: Total | None = None
    untested: UntestedPoints | None = None
    notes: list[str] = []

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        faults: list[Fault] = []
        if self.relaxation is not None:
            unknown = sorted(set(self.relaxation.limits) - set(self.limits or ()))
            if unknown:
                faults.append(
                    (
                        ("relaxation", "limits", unknown[0]),
                        f"`{unknown[0]}` has no limit to be relaxed; leave it out, or give it a limit",
                    )
                )
        if self.limits is not None and self.total is not None:
            faults.append((("total",), "a scheme of limits gives no points; leave one of the two out"))
        if faults:
            raise Faults(faults)
        return self
