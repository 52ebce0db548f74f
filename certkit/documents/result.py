"""`Result`: the one document that everything after grading is rendered from (schema `certkit-result/1`).

It holds no objects, only words, numbers and lists, so that a report can be rendered again from the JSON
alone. Values stand in the unit named beside them, times in seconds. Fields may be added; none changes its
meaning. Reasons stand as codes (`coded_reason`) beside their English words (`reason`), which no id covers.
"""

from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from certkit.definitions.provenance import Confidence
from certkit.documents.consistent_lists import check_axis, check_lengths, check_sizes, plain_name
from certkit.documents.data_frames import CriteriaFrame, SeriesFrame
from certkit.documents.list_by_id import ListById
from certkit.documents.output_document import NOT_IN_ID, OutputDocument, Part
from certkit.documents.rig_motion import Motion
from certkit.documents.rounding import Figure, Figures, Point, Points
from certkit.reasons import Reason

Verdict = Literal["pass", "fail", "conditional", "not evaluated", "error"]
ResultKind = Literal["virtual certification", "virtual test", "test evaluation"]


class Spread(Part):
    """A criterion's value over a family of certified legs."""

    members: int
    minimum: Figure
    maximum: Figure
    mean: Figure
    standard_deviation: Figure
    passing: Annotated[
        Figure | None, Field(description="Share of the legs that pass; none where nothing is graded.")
    ] = None


class Uncertainty(Part):
    """Uncertainties of one value, in the criterion's unit."""

    numerical: Annotated[Figure | None, Field(description="From step and iteration refinement.")] = None
    expanded: Annotated[Figure | None, Field(description="Measurement, k = 2, from the laboratory file.")] = (
        None
    )
    guard_band: Annotated[Figure | None, Field(description="w = r·U of the decision rule.")] = None
    false_accept: Annotated[Figure | None, Field(description="Probability of a false accept.")] = None


class CurveInPlane(Part):
    """A curve over another channel, with the polygon it is held against when there is one."""

    x_title: str
    x_unit: str
    y_title: str
    y_unit: str
    points: Points
    polygon: Points | None = None


class CorridorOverTime(Part):
    """A corridor over time in the criterion's unit: polylines of (time in s, value)."""

    lower: Points | None = None
    upper: Points | None = None


class CriterionResult(Part):
    """One criterion: what was measured, what it was held against and what came of it."""

    id: str
    title: str
    value: Figure | None = Field(description="None when it could not be measured.")
    unit: str
    lower: Figure | None = None
    upper: Figure | None = None
    margin: Annotated[
        Figure | None, Field(description="Distance to the nearer limit; negative when outside.")
    ] = None
    time: Annotated[Figure | None, Field(description="When the value occurred, s after contact.")] = None
    verdict: Verdict
    graded: Annotated[bool, Field(description="False: informative, no corridor is known.")] = True
    reason: Annotated[str, Field(description="Why, where the verdict alone does not say it.")] = ""
    coded_reason: Reason | None = None
    confidence: Confidence | None = None
    source: str = ""
    corridor: Annotated[str, Field(description="Corridor as named in the procedure.")] = ""
    note: Annotated[str, Field(description="What a reader should know about it or its corridor.")] = ""
    channel: Annotated[str, Field(description="Short name of the channel.")] = ""
    measure: str = ""
    filter: str = "none"
    uncertainty: Uncertainty | None = None
    spread: Spread | None = None
    curve: CurveInPlane | None = None
    band: CorridorOverTime | None = None


CALIBRATION = "calibration left, "
"""Begins the quantity of a condition that is a calibration."""


class PreconditionResult(Part):
    """A condition of the test."""

    quantity: str
    value: Figure | None
    unit: str
    lower: Figure | None = None
    upper: Figure | None = None
    verdict: Verdict
    reason: str = ""
    coded_reason: Reason | None = None
    required: Annotated[bool, Field(description="False: a missing value does not matter.")] = True
    confidence: Annotated[Confidence | None, Field(description="Of the limit, where it is told.")] = None
    source: str = ""


class ScoreResult(Part):
    """Points of a rating scheme."""

    id: str
    points: Figure
    maximum: Figure
    criterion: Annotated[str, Field(description="The criterion that decided.")]
    value: Figure
    unit: str
    full: Figure
    zero: Figure
    scheme: Annotated[str, Field(description="Name of the corridor set with the scheme.")] = ""
    colour: Annotated[str, Field(description="Of the band that decided, where the scheme has bands.")] = ""
    car_points: Annotated[
        Figure | None, Field(description="Points of the whole car: times the mean share over its points.")
    ] = None
    confidence: Confidence
    source: str
    note: str = ""


class ComparisonRow(Part):
    """A line of an error table like the paper's Table 1."""

    channel: str
    unit: str = "N·m"
    test: Figure
    simulation: Figure
    error_percent: Figure
    published: Annotated[Figure | None, Field(description="The published simulation's value.")] = None
    published_error_percent: Figure | None = None


class Comparison(Part):
    """Error table against a reference; the error is (simulation − test) / test."""

    reference: str
    title: str = ""
    rms_error_percent: Figure
    published_rms_error_percent: Figure | None = None
    rows: list[ComparisonRow]
    notes: list[str] = []
    coded_notes: list[Reason] = []


class QualityCheck(Part):
    """One limit of the numerical quality gate."""

    title: str = ""
    coded_title: Reason | None = None
    value: Figure
    limit: Figure
    unit: str
    verdict: Verdict
    remedy: Annotated[Reason | None, Field(description="Where it is exceeded: what to do about it.")] = None


class Quality(Part):
    """Whether a simulated run can be trusted."""

    verdict: Verdict
    energy_error_percent: Figure
    joint_gap_mm: Figure
    step_change_percent: Figure | None
    penetration_mm: Figure | None = None
    steps: int
    time_step: Figure
    solver_seconds: Annotated[
        float | None, NOT_IN_ID, Field(description="Processor time; left out of hashes and comparisons.")
    ] = None
    checks: list[QualityCheck] = []


class Series(Part):
    """A channel's values on the shared time axis, in its unit."""

    title: str
    unit: str
    values: Figures
    filter: str = "none"


class Histories(SeriesFrame, Part):
    """Channels on one uniform time axis."""

    start: Figure
    interval: Figure
    count: int
    series: dict[str, Series]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse series that do not lie on the time axis."""
        check_axis(self.start, self.interval, self.count)
        check_lengths(self.count, {name: each.values for name, each in self.series.items()}, "samples")
        for name, each in self.series.items():
            check_sizes(name, each.values)
        return self


class InputFile(Part):
    """A file the result rests on."""

    role: Annotated[str, Field(description="procedure, legform, corridors, reference, vehicle, recording, …")]
    path: Annotated[str, Field(description="As found: a shipped name or the user's path, never absolute.")]
    sha256: str
    text: Annotated[str | None, Field(description="The file itself where it is a definition.")] = None


class Override(Part):
    """A value changed for this run with `--set`."""

    path: str
    value: str
    was: str | None = None


class Provenance(Part):
    """What produced the document."""

    certkit: str
    inputs: list[InputFile]
    packages: Annotated[dict[str, str], NOT_IN_ID]
    overrides: list[Override] = []


class Parameter(Part):
    """A number that went in, with its origin."""

    path: str
    value: str
    source: str
    confidence: Confidence


class Front(Part):
    """What the front of a vehicle did: time axes as in `Histories`, displacements and shortenings in mm."""

    contact: Annotated[Histories, Field(description="Force of the leg on each face, N.")]
    displacement: Annotated[Histories, Field(description="Of each group along the car, mm.")]
    springs: Annotated[
        dict[str, CurveInPlane], Field(description="Force over shortening of each connection.")
    ]
    received: Annotated[dict[str, Figure], Field(description="Energy that each face took from the leg, J.")]
    absorbed: Annotated[dict[str, Figure], Field(description="Energy that each connection kept, J.")]


class Result(CriteriaFrame, OutputDocument):
    """The result document."""

    noun: ClassVar = "result"
    file_name: ClassVar = "result.json"
    made_by: ClassVar = "certkit run"

    schema_: Annotated[Literal["certkit-result/1"], Field(alias="schema")] = "certkit-result/1"
    kind: ResultKind
    procedure: Annotated[str, AfterValidator(plain_name)]
    title: str
    verdict: Verdict
    remarks: Annotated[list[str], Field(description="What the verdict rests on and does not cover.")] = []
    coded_remarks: list[Reason] = []
    method: str = ""
    specimen: dict[str, str] = {}
    decision_rule: str = "simple acceptance"
    coded_decision_rule: Reason | None = None
    criteria: ListById[CriterionResult]
    preconditions: list[PreconditionResult] = []
    conditions: Annotated[dict[str, Figure], Field(description="Of the test, SI, by their words.")] = {}
    scores: list[ScoreResult] = []
    comparison: Comparison | None = None
    quality: Quality | None = None
    interval: Annotated[Point | None, Field(description="Assessment interval, s.")] = None
    energies: Annotated[Histories | None, Field(description="Energy over time, by where it went.")] = None
    curves: Annotated[Histories | None, Field(description="Conditioned channels, thinned out.")] = None
    channels: Annotated[Histories | None, Field(description="Channels as recorded, unfiltered.")] = None
    motion: Motion | None = None
    front: Annotated[Front | None, Field(description="What the vehicle's front did.")] = None
    parameters: list[Parameter] = []
    laboratory: Annotated[dict[str, Any] | None, Field(description="Header data of a laboratory.")] = None
    notes: list[str] = []
    coded_notes: list[Reason] = []
    provenance: Provenance
