"""What a comparison of two tests has to keep, so that the one may stand for the other: the rule of a gate."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Section, Sourced
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.units import parse_quantity

Share = Annotated[float, Field(ge=0, le=1)]


class RatingLimits(Sourced):
    """Least ISO/TS 18571 ratings, from 0 to 1."""

    noun: ClassVar[str] = "rating"

    each: Annotated[Share | None, Field(description="Of every channel.")] = None
    mean: Annotated[Share | None, Field(description="Of the channels' mean.")] = None

    def lines(self) -> dict[str, str]:
        """Return its numbers as people read them."""
        given = {"each": self.each, "mean": self.mean}
        return {key: f"{value:g}" for key, value in given.items() if value is not None}


class PeakLimit(Sourced):
    """Largest difference of peaks, or of the criteria where both tests were graded by one procedure."""

    within: Annotated[str, Field(description="Of the reference's value, such as `10 %`.")]

    @model_validator(mode="after")
    def _is_a_share(self) -> Self:
        _refuse_odd(within=self.within)
        return self

    def lines(self) -> dict[str, str]:
        """Return its number as people read it."""
        return {"within": self.within}


class CriterionLimit(Sourced):
    """Largest difference of a criterion over its limit, asked only where the reference comes near that limit.

    With the criterion's limit L, r_AC = reference / L and d_AC = |compared − reference| / L.
    """

    above: Annotated[str, Field(description="Least r_AC from which on d_AC is asked, such as `50 %`.")]
    within: Annotated[str, Field(description="d_AC has to stay below, such as `30 %`.")]

    @model_validator(mode="after")
    def _are_shares(self) -> Self:
        _refuse_odd(above=self.above, within=self.within)
        return self

    def lines(self) -> dict[str, str]:
        """Return its numbers as people read them."""
        return {"above": self.above, "within": self.within}


class AgreementRule(Section):
    """A rule in a file: each part that stands there is asked, and all have to be kept."""

    agreement: Annotated[str, Field(description="Its name.")]
    title: str
    channels: Annotated[
        list[str],
        Field(
            max_length=200,
            description="Short names of the channels that count; all shared ones when missing.",
        ),
    ] = []
    rating: RatingLimits | None = None
    peak: PeakLimit | None = None
    criteria: CriterionLimit | None = None
    notes: list[str] = []

    @model_validator(mode="after")
    def _asks_something(self) -> Self:
        asked = self.rating is not None and self.rating.lines()
        if not asked and self.peak is None and self.criteria is None:
            raise Faults([((), "asks nothing; add `rating`, `peak` or `criteria`")])
        return self


def _refuse_odd(**shares: str) -> None:
    """Refuse texts that are no shares of 0 or more."""
    faults: list[Fault] = []
    for key, text in shares.items():
        try:
            if parse_quantity(text, "ratio") < 0:
                faults.append(((key,), f"`{text}` is negative; a share is not"))
        except ValueError as error:
            faults.append(((key,), str(error)))
    if faults:
        raise Faults(faults)
