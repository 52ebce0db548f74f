"""`CampaignReport`: a car judged by its impact points (schema `certkit-campaign/1`)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import AfterValidator, Field

from certkit.definitions.campaign import SourceKind
from certkit.definitions.provenance import Confidence
from certkit.documents.consistent_lists import plain_name
from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.result import Provenance, Verdict
from certkit.documents.rounding import Figure, Point
from certkit.reasons import Reason

Basis = Literal["own", "mirrored", "neighbour", "none"]
"""What a point's judgement stands on: its own values, the point on the other side, the worse neighbour."""


class PointValue(Part):
    """One criterion's value from one source."""

    id: str
    title: str = ""
    value: Figure | None = None
    unit: str
    guard: Annotated[Figure | None, Field(description="Guard band of the laboratory's decision rule.")] = None
    reason: Annotated[str, Field(description="Why it cannot be used, where it cannot.")] = ""
    coded_reason: Reason | None = None


class SourceReport(Part):
    """One source of a point's values."""

    kind: SourceKind
    label: Annotated[str, Field(description="File, procedure or who says so.")]
    verdict: Annotated[Verdict | None, Field(description="Of the result, where there is one.")] = None
    values: list[PointValue] = []
    usable: Annotated[bool, Field(description="False: the test or run does not count as a whole.")] = True
    reason: Annotated[str, Field(description="Why it does not.")] = ""
    coded_reason: Reason | None = None
    decides: Annotated[bool, Field(description="Its values are the ones that are judged.")] = False
    replaced: Annotated[bool, Field(description="A later run has taken its place.")] = False
    certificate: Annotated[str, Field(description="Id of the result.")] = ""
    folder: Annotated[
        str,
        Field(
            pattern=r"^(points/[A-Za-z0-9_+-]+)?$", description="Of the result, from this document's folder."
        ),
    ] = ""
    changes: Annotated[dict[str, str], Field(description="Values changed in a simulation.")] = {}


class PointReport(Part):
    """One impact point: where it is, and what is known of it."""

    name: str
    across: Annotated[Figure, Field(description="From the car's middle, mm; positive to its own left.")]
    height: Annotated[Figure, Field(description="Above the ground, mm.")]
    angle: Annotated[Figure, Field(description="Of the velocity to the car's long axis, deg.")] = 0.0
    column: Annotated[int | None, Field(description="Of Euro NCAP's grid.")] = None
    relaxed: Annotated[bool, Field(description="Lies in a zone that the maker chose.")] = False
    sources: list[SourceReport] = []
    replacement: Annotated[str, Field(description="Why older values decide no longer.")] = ""


class JudgedCriterion(Part):
    """One criterion of a point, held against a scheme."""

    id: str
    unit: str
    value: Figure | None = None
    limit: Annotated[Figure, Field(description="Upper limit; of a score the value from which on it is none.")]
    full: Annotated[Figure | None, Field(description="Of a score: full points below.")] = None
    percent: Annotated[Figure | None, Field(description="Value over limit, %.")] = None
    verdict: Annotated[Verdict | None, Field(description="None where points are given.")] = None
    share: Annotated[Figure | None, Field(description="Of the points of its group, from 0 to 1.")] = None


class JudgedPoint(Part):
    """What a scheme says of one point."""

    point: str
    basis: Basis
    of: Annotated[str, Field(description="The points whose values stand here, where they are others.")] = ""
    source: Annotated[SourceKind | None, Field(description="Of the values.")] = None
    criteria: list[JudgedCriterion] = []
    worst: Annotated[str, Field(description="The criterion nearest to, or farthest beyond, its limit.")] = ""
    percent: Annotated[Figure | None, Field(description="Of that criterion.")] = None
    verdict: Annotated[Verdict | None, Field(description="None where points are given.")] = None
    points: Figure | None = None
    maximum: Figure | None = None
    shares: Annotated[dict[str, Figure], Field(description="Share of each score, from 0 to 1.")] = {}
    reason: Annotated[str, Field(description="Why it is not evaluated, or earns nothing.")] = ""
    coded_reason: Reason | None = None


class JudgedScheme(Part):
    """What one scheme says of the car."""

    scheme: str
    title: str
    kind: Literal["limits", "targets", "points"]
    verdict: Annotated[Verdict | None, Field(description="None: points without a target gate nothing.")] = (
        None
    )
    points: list[JudgedPoint]
    worst_point: str = ""
    total: Annotated[Figure | None, Field(description="Points of the car, where the rule is known.")] = None
    maximum: Figure | None = None
    percent: Annotated[Figure | None, Field(description="Mean share of the points, %.")] = None
    at_least: Annotated[Figure | None, Field(description="Points asked for.")] = None
    sources: Annotated[list[str], Field(description="Texts that limits, scores and rules come from.")] = []
    confidences: list[Confidence] = []
    remarks: list[str] = []
    coded_remarks: list[Reason] = []


class AgreementRow(Part):
    """A predicted value beside the measured one; the error is (measured − predicted) / predicted."""

    point: str
    criterion: str
    unit: str
    kind: SourceKind
    predicted: Figure
    measured: Figure
    error_percent: Figure
    within: Annotated[bool | None, Field(description="Whether it keeps the tolerance, if one is set.")] = None


class CarFront(Part):
    """The car as it is drawn, mm."""

    name: str
    width: Figure
    height: Figure
    bonnet_edge: Figure
    bumper: Figure
    test_area: Point | None = None
    zones: Annotated[list[Point], Field(description="Where relaxed limits hold.")] = []
    symmetric: bool = False


class CampaignReport(OutputDocument):
    """A car, its impact points with all their sources, and what each scheme says of them."""

    noun: ClassVar = "campaign"
    file_name: ClassVar = "campaign.json"
    made_by: ClassVar = "certkit campaign"

    schema_: Annotated[Literal["certkit-campaign/1"], Field(alias="schema")] = "certkit-campaign/1"
    campaign: Annotated[str, AfterValidator(plain_name)]
    title: str
    verdict: Verdict
    car: CarFront
    schemes: list[JudgedScheme]
    points: list[PointReport]
    agreement: list[AgreementRow] = []
    tolerance_percent: Annotated[Figure | None, Field(description="Asked of the agreement.")] = None
    remarks: list[str] = []
    coded_remarks: list[Reason] = []
    notes: list[str] = []
    provenance: Provenance
