"""Scores of rating schemes: points for a value on a sliding scale, or by the band that it lies in."""

from typing import Annotated, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Document
from certkit.definitions.corridor_entry import CorridorEntry, order_faults
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import alike


class Forfeit(Document):
    """Criteria that take all points of a score away when any of them reaches a value."""

    criteria: Annotated[list[str], Field(min_length=1)]
    at: Annotated[str, Field(description="The value, with its unit; reaching it is enough.")]


class SlidingScale(Document):
    """Criteria with the values between which their points go from all to none."""

    criteria: Annotated[list[str], Field(min_length=1, description="The worst of these criteria counts.")]
    full: Annotated[str, Field(description="All points below it (higher performance limit).")]
    zero: Annotated[str, Field(description="No points from it on (lower performance limit).")]

    @model_validator(mode="after")
    def _scale_has_order(self) -> Self:
        if faults := order_faults(("full", self.full), ("zero", self.zero)):
            raise Faults(faults)
        return self


Share = Annotated[float, Field(gt=0, lt=1)]


class Score(CorridorEntry, SlidingScale):
    """Points of one body region at one point of impact: all of them below `full`, none from `zero` on.

    Between the two they fall on a straight line, or, where `shares` are given, in steps: the range is cut
    into as many bands of equal width, and each band has its share of the points.
    """

    points: Annotated[float, Field(gt=0)]
    also: Annotated[list[SlidingScale], Field(description="Further criteria on scales of their own.")] = []
    forfeit: Forfeit | None = None
    shares: Annotated[
        list[Share], Field(max_length=20, description="Share of the points in each band, falling.")
    ] = []
    colours: Annotated[
        list[str], Field(description="Of all points, of each band, of none: two more than `shares`.")
    ] = []
    decimals: Annotated[
        int | None,
        Field(
            ge=0,
            le=6,
            description="Decimals, in the unit of the scale, to which values and bands are rounded half up.",
        ),
    ] = None
    point_decimals: Annotated[
        int | None, Field(ge=0, le=6, description="Decimals of the points, rounded half up.")
    ] = None
    car_points: Annotated[
        float | None,
        Field(gt=0, description="Points of the whole car for it: times the mean share over all its points."),
    ] = None

    @property
    def scales(self) -> list[SlidingScale]:
        """Return all scales; the worst value on any of them decides."""
        return [self, *self.also]

    @property
    def needs(self) -> list[str]:
        """Return every criterion that it takes to give the score."""
        named = [i for scale in self.scales for i in scale.criteria]
        return list(dict.fromkeys([*named, *(self.forfeit.criteria if self.forfeit else ())]))

    @model_validator(mode="after")
    def _bands_fit(self) -> Self:
        faults: list[Fault] = []
        if any(late >= early for early, late in zip(self.shares, self.shares[1:], strict=False)):
            faults.append((("shares",), "the shares of the bands have to fall; give them in that order"))
        if self.colours and len(self.colours) != len(self.shares) + 2:
            message = f"{len(self.shares)} bands have {len(self.shares) + 2} colours, not {len(self.colours)}"
            faults.append((("colours",), message))
        if self.forfeit is not None:
            faults += [(("forfeit", "at"), said) for _, said in alike([self.forfeit.at])[1]]
        if faults:
            raise Faults(faults)
        return self

    def lines(self) -> dict[str, str]:
        """Return the scales and, where there is one, what forfeits the points."""
        steps = "".join(f", {share:g}" for share in self.shares)
        between = f" in steps{steps}" if steps else ""
        lines = {"": f"{self.points:g} points up to {self.full}, none from {self.zero} on{between}"}
        for index, scale in enumerate(self.also):
            lines[f"also.{index}"] = f"{', '.join(scale.criteria)}: {scale.full} to {scale.zero}"
        if self.forfeit is not None:
            lines["forfeit"] = f"{' or '.join(self.forfeit.criteria)} at {self.forfeit.at}"
        return lines
