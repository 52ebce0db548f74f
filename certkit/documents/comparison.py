"""`ComparisonDocument`: two tests beside each other (schema `certkit-comparison/1`); pages need it alone."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from certkit.documents.consistent_lists import check_axis, check_lengths, check_sizes
from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.result import ComparisonRow, InputFile, Verdict
from certkit.documents.rounding import Figure, Figures
from certkit.reasons import Reason


class Side(Part):
    """One of the two tests."""

    label: Annotated[str, Field(description="As the user named it.")]
    kind: Literal["simulated", "measured", "virtual"]
    title: str = ""
    procedure: str = ""
    verdict: Verdict | None = None
    id: Annotated[str, Field(description="Certificate id, where it is a result.")] = ""


class ChannelRating(Part):
    """ISO/TS 18571 rating of one channel, each part from 0 to 1; where none can be given, the reason."""

    channel: str
    title: str
    corridor: Figure | None = None
    phase: Figure | None = None
    magnitude: Figure | None = None
    slope: Figure | None = None
    overall: Figure | None = None
    grade: str = ""
    reason: str = ""
    coded_reason: Reason | None = None
    causes: Annotated[list[str], Field(description="What parts that are not good come from.")] = []
    coded_causes: list[Reason] = []


class AgreementCheck(Part):
    """One line of a rule that a comparison is held against."""

    kind: Annotated[str, Field(description="`rating`, `mean-rating`, `peak` or `criterion`.")]
    title: str = ""
    coded_title: Reason | None = None
    channel: Annotated[str, Field(description="Channel or criterion; empty where all are meant.")] = ""
    value: Figure | None
    lower: Figure | None = None
    upper: Figure | None = None
    unit: str = ""
    verdict: Verdict
    reason: str = ""
    coded_reason: Reason | None = None


class Overlay(Part):
    """One channel of both tests on one time axis, with the difference (other − reference)."""

    channel: str
    title: str
    unit: str
    filter: str
    start: Figure
    interval: Figure
    reference: Figures
    other: Figures
    difference: Figures

    @property
    def milliseconds(self) -> list[float]:
        """The time axis, ms."""
        return [(self.start + k * self.interval) * 1e3 for k in range(len(self.reference))]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse curves that do not lie on one time axis."""
        lists = {"reference": self.reference, "other": self.other, "difference": self.difference}
        check_axis(self.start, self.interval, len(self.reference))
        check_lengths(len(self.reference), lists, "samples")
        for name, values in lists.items():
            check_sizes(name, values)
        return self


class ComparisonDocument(OutputDocument):
    """Two tests beside each other. Errors are (other − reference) / reference, as in the paper's Table 1."""

    noun: ClassVar = "comparison"
    file_name: ClassVar = "comparison.json"
    made_by: ClassVar = "certkit compare"

    schema_: Annotated[Literal["certkit-comparison/1"], Field(alias="schema")] = "certkit-comparison/1"
    title: str
    reference: Side
    other: Side
    rows: list[ComparisonRow] = Field(default_factory=list)
    rms_error_percent: Figure | None = None
    interval: Annotated[tuple[Figure, Figure], Field(description="Time that is compared, s.")]
    ratings: list[ChannelRating] = Field(default_factory=list)
    rating: Annotated[Figure | None, Field(description="Mean of the channels' overall ratings.")] = None
    grade: str = ""
    overlays: list[Overlay] = Field(default_factory=list)
    rule: Annotated[str, Field(description="Title of the rule that it was held against.")] = ""
    verdict: Annotated[Verdict | None, Field(description="By the rule; none without one.")] = None
    checks: list[AgreementCheck] = Field(default_factory=list)
    inputs: Annotated[list[InputFile], Field(description="The rule's file.")] = Field(default_factory=list)
    notes: list[str] = Field(default_factory=list)
    coded_notes: list[Reason] = Field(default_factory=list)
