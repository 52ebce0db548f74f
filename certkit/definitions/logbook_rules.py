"""The logbook's rules: when a legform has to be certified again, and from when on a trend is one."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

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


class TestSequence(Sourced):
    """Certification tests that follow each other in turn, with at most so many tests between any two.

    The first of the turn opens a series. After the last one the turn starts again.
    """

    rule: Literal["sequence"]
    title: str
    certified_by: Annotated[Procedures, Field(description="In their order; one may stand there twice.")]
    counts: Annotated[Procedures, Field(description="Procedures whose tests are counted.")]
    at_most: Annotated[int, Field(ge=1, le=1_000_000)]

    def lines(self) -> dict[str, str]:
        """Return its number as people read it."""
        return {"at most": str(self.at_most)}


class Overload(Sourced):
    """A reading so far beyond its limit, or beyond its amplitude class, ends the certification at once."""

    rule: Literal["overload"]
    title: str
    certified_by: Procedures
    counts: Annotated[Procedures, Field(description="Procedures whose readings are looked at.")]
    beyond: Annotated[
        str | None, Field(description="Share of the upper limit: `10 %`. Either this or `classes`.")
    ] = None
    classes: Annotated[list[str], Field(description="Channel amplitude classes: `[400 N·m, 30 mm]`.")] = []

    @model_validator(mode="after")
    def _has_a_bound(self) -> Self:
        if (self.beyond is None) == (not self.classes):
            raise ValueError("an overload is a reading `beyond` a share of its limit, or of one of `classes`")
        if self.beyond is not None and parse_quantity(self.beyond, "ratio") <= 0:
            raise ValueError(f"`{self.beyond}` has to be greater than zero")
        self._by_unit()
        return self

    def _by_unit(self) -> dict[str, float]:
        """Return the classes by their unit."""
        found = {}
        for text in self.classes:
            number, _, unit = text.strip().partition(" ")
            try:
                found[unit] = float(number)
            except ValueError:
                unit = ""
            if not unit:
                raise ValueError(f"`{text}` is no amplitude class; write a number and its unit: `400 N·m`")
        return found

    def bound(self, upper: float | None, unit: str) -> float | None:
        """Return the reading that is one too many, in its unit; None where nothing is said."""
        if self.beyond is not None:
            return None if upper is None or upper <= 0 else upper * (1 + parse_quantity(self.beyond, "ratio"))
        return self._by_unit().get(unit)

    def lines(self) -> dict[str, str]:
        """Return its numbers as people read them."""
        return {"beyond": self.beyond} if self.beyond is not None else {"classes": ", ".join(self.classes)}


Rule = Annotated[Interval | Count | TestSequence | Overload, Field(discriminator="rule")]


class PublishedVariation(Sourced):
    """A published coefficient of variation of a test, to hold a legform's own against."""

    procedure: str
    below: Annotated[str, _readable("ratio")]

    @property
    def percent(self) -> float:
        """The coefficient, %."""
        return 100 * parse_quantity(self.below, "ratio")

    def lines(self) -> dict[str, str]:
        """Return its number as people read it."""
        return {"below": self.below}


class TrendRule(Document):
    """When a row of values is long enough to be judged, and what its scatter is held against."""

    at_least: Annotated[int, Field(ge=3, le=1000, description="Tests of one kind.")] = 5
    published: Annotated[list[PublishedVariation], Field(max_length=50)] = []


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
