"""The logbook's rules: when a legform has to be certified again, and from when on a trend is one."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from certkit.definitions.base import Document, Sourced
from certkit.definitions.units import parse_quantity


def _readable(dimension: str) -> AfterValidator:
    """Check that a text is a quantity greater than zero."""

    def check(text: str) -> str:
        if parse_quantity(text, dimension) <= 0:
            raise ValueError(f"`{text}` has to be greater than zero")
        return text

    return AfterValidator(check)


Procedures = Annotated[list[str], Field(min_length=1, max_length=50)]


class Interval(Sourced):
    """Each of these procedures has to be passed again before so much time has gone by."""

    rule: Literal["interval"]
    title: str
    certified_by: Procedures
    every: Annotated[str, _readable("time")]

    @property
    def seconds(self) -> float:
        """The time, s."""
        return parse_quantity(self.every, "time")

    def lines(self) -> dict[str, str]:
        """Return its number as people read it."""
        return {"every": self.every}


class Count(Sourced):
    """After so many tests of one kind, each of these procedures has to be passed again."""

    rule: Literal["count"]
    title: str
    certified_by: Procedures
    counts: Annotated[Procedures, Field(description="Procedures whose tests are counted.")]
    at_most: Annotated[int, Field(ge=1, le=1_000_000)]

    def lines(self) -> dict[str, str]:
        """Return its number as people read it."""
        return {"at most": str(self.at_most)}


class Overload(Sourced):
    """A reading so far beyond its limit ends the certification at once."""

    rule: Literal["overload"]
    title: str
    certified_by: Procedures
    counts: Annotated[Procedures, Field(description="Procedures whose readings are looked at.")]
    beyond: Annotated[str, _readable("ratio"), Field(description="Share of the upper limit: `10 %`.")]

    @property
    def share(self) -> float:
        """The share as a number."""
        return parse_quantity(self.beyond, "ratio")

    def lines(self) -> dict[str, str]:
        """Return its number as people read it."""
        return {"beyond": self.beyond}


Rule = Annotated[Interval | Count | Overload, Field(discriminator="rule")]


class TrendRule(Document):
    """When a row of values is long enough to be judged."""

    at_least: Annotated[int, Field(ge=3, le=1000, description="Tests of one kind.")] = 5


class LogbookRules(Document):
    """Rules of validity, each with its source."""

    logbook: Annotated[str, Field(description="Name of the rules.")]
    title: str
    rules: Annotated[list[Rule], Field(min_length=1, max_length=50)]
    trend: TrendRule = TrendRule()
    serial_numbers: Annotated[
        Literal["without case", "exact"],
        Field(description="Whether `flx-0007` and `FLX-0007` are one legform, or two."),
    ] = "without case"
