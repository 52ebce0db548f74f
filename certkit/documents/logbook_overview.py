"""The overview of one legform as a document (schema `certkit-logbook/1`): text and page come from it."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from certkit.definitions.provenance import Confidence
from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.rounding import Figure, Points
from certkit.reasons import Reason

State = Literal["valid", "due", "revoked", "never certified"]
"""Of one rule, or of a legform by all of them."""


class TestLine(Part):
    """One test."""

    day: str
    number: str
    procedure: str
    verdict: str
    id: str
    replaced_by: Annotated[str | None, Field(description="Id of the report that replaced it.")] = None


class Validity(Part):
    """What one rule says."""

    rule: Literal["interval", "count", "sequence", "overload"]
    title: str
    state: State
    why: str = ""
    coded_why: Annotated[Reason | None, Field(description="What its state follows from.")] = None
    due: Annotated[str | None, Field(description="Day from which on a certification is due.")] = None
    left: Annotated[int | None, Field(description="Tests left until one is due.")] = None
    used: Annotated[int | None, Field(description="Tests since the last certification.")] = None
    source: str
    confidence: Confidence


class Trend(Part):
    """One channel over the tests of one procedure."""

    procedure: str
    criterion: str
    title: str
    unit: str
    days: list[str]
    values: list[Figure]
    lower: Figure | None
    upper: Figure | None
    count: int
    mean: Figure
    standard_deviation: Figure | None
    variation_percent: Annotated[Figure | None, Field(description="%CV: deviation / |mean|.")]
    published_percent: Annotated[Figure | None, Field(description="A published %CV to hold it against.")] = (
        None
    )
    published_source: str = ""
    control_lower: Annotated[Figure | None, Field(description="Individuals chart: mean − 2.66·mean range.")]
    control_upper: Figure | None
    outside_control: Annotated[list[int], Field(description="Tests beyond the control limits, from 1.")]
    slope_per_year: Figure | None
    drifts: Annotated[bool, Field(description="The slope is more than twice its standard error.")]
    leaves: Annotated[str | None, Field(description="Day on which the drift leaves the corridor.")]
    remark: str = ""
    coded_remark: Annotated[Reason | None, Field(description="Whether it drifts, and where to.")] = None


class CurveOfTest(Part):
    """The curve of one test."""

    day: str
    number: str
    id: str
    points: Annotated[Points, Field(description="Time in ms or the channel along, and the value.")]


class PastCurves(Part):
    """The curves that one criterion looked at in the last tests of a procedure, the latest last."""

    procedure: str
    criterion: str
    title: str
    x_title: str
    unit: str
    lower: Figure | None = None
    upper: Figure | None = None
    polygon: Points | None = None
    curves: list[CurveOfTest]


class LegOverview(OutputDocument):
    """Everything the logbook knows of one legform."""

    noun: ClassVar = "logbook overview"
    file_name: ClassVar = "logbook.json"
    made_by: ClassVar = "certkit history show --json"

    schema_: Annotated[Literal["certkit-logbook/1"], Field(alias="schema")] = "certkit-logbook/1"
    serial: str
    day: Annotated[str, Field(description="The day it is drawn up for.")]
    rules: str
    certified_by: Annotated[list[str], Field(description="Procedures that the rules ask for.")] = []
    serial_numbers: Annotated[str, Field(description="How serial numbers are told apart.")] = "without case"
    state: State
    tests: list[TestLine]
    counts: Annotated[dict[str, int], Field(description="Tests by procedure.")]
    validity: list[Validity]
    trends: list[Trend]
    curves: Annotated[list[PastCurves], Field(description="The last curves of each channel.")] = []
