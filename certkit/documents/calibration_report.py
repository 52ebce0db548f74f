"""`CalibrationReport`: what a calibration came to and how well the tests know it (schema `certkit-fit/1`)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.rounding import Figure, FigureOrWord


class FittedValue(Part):
    """A value of a test, before and after, and its distance from where it should be."""

    name: Annotated[str, Field(description="`PROCEDURE/CRITERION`.")]
    unit: str
    aim: Figure
    counts_as_one: Annotated[
        Figure, Field(description="What counts as a distance of one: half the corridor, or the tolerance.")
    ]
    graded: bool
    before: FigureOrWord | None
    after: FigureOrWord | None
    distance_before: Figure
    distance_after: Figure
    left_out: Annotated[FigureOrWord | None, Field(description="After a fit to all values but this one.")] = (
        None
    )


class Following(Part):
    """How well a simulated curve follows a recorded one inside the window; none where the run failed."""

    rms_percent: Annotated[
        Figure | None, Field(description="Root mean square of the difference, of the recorded peak.")
    ] = None
    peak: Figure | None = None
    peak_error_percent: Figure | None = None
    time_error_ms: Annotated[
        Figure | None,
        Field(description="How much later than recorded the peak comes; curves over time only."),
    ] = None
    score: Annotated[Figure | None, Field(description="ISO/TS 18571, where a target asks for it.")] = None


class FollowedCurve(Part):
    """A recorded curve that the fit aimed at, and the simulated one before and after it."""

    name: Annotated[str, Field(description="`PROCEDURE/CHANNEL over time`, or over another channel.")]
    unit: str
    window: tuple[Figure, Figure]
    window_unit: str
    recorded_peak: Figure
    before: Following
    after: Following


class FittedParameter(Part):
    """A parameter that was free, in its unit."""

    name: str
    unit: str
    before: Figure
    after: Figure
    deviation: Annotated[Figure, Field(description="Standard deviation that tests, bounds and priors leave.")]
    lower: Annotated[Figure, Field(description="Bound.")]
    upper: Annotated[Figure, Field(description="Bound.")]
    narrowed_to: Annotated[
        Figure,
        Field(description="Deviation that the tests leave without priors, of what the bounds alone leave."),
    ]
    determined: Annotated[bool, Field(description="False: the tests say hardly more than the bounds.")]
    on_bound: Annotated[
        bool, Field(description="True: it stands on a bound, and the tests would rather have it beyond.")
    ] = False
    reason: Annotated[str, Field(description="Why these bounds.")] = ""


class StrongCorrelation(Part):
    """Two parameters that the tests cannot well tell apart."""

    between: tuple[str, str]
    coefficient: Figure


class OpenDirection(Part):
    """Parameters that can change together without the tests noticing."""

    spread: Annotated[Figure, Field(description="As a part of the bounds' own spread.")]
    parts: Annotated[dict[str, Figure], Field(description="Each parameter's part of the direction.")]


class ReachedBasin(Part):
    """A place that a search came to."""

    start: Annotated[str, Field(description="The seed of the places it began from.")]
    rms: Annotated[Figure, Field(description="Of all values, in what counts as one.")]
    squares: Annotated[Figure, Field(description="Sum of squares, pulls to priors and middles included.")]
    distance: Annotated[
        Figure, Field(description="From the fitted leg: root mean square of the parameters' shares.")
    ]


class FamilyFigures(Part):
    """How much of what the bounds allow the family covers."""

    members: int
    coverage: Annotated[Figure, Field(description="Range of each parameter over its bounds, averaged.")]
    evenness: Annotated[
        Figure, Field(description="Standard deviation over that of an even spread, averaged.")
    ]
    dimensions: Annotated[Figure, Field(description="Directions in which members differ.")]
    distance: Annotated[
        Figure, Field(description="Of a member from the nearest other, over that of an even spread.")
    ]


class CalibrationReport(OutputDocument):
    """What a calibration came to."""

    noun: ClassVar = "calibration report"
    file_name: ClassVar = "fit.json"
    made_by: ClassVar = "certkit calibrate"

    schema_: Annotated[Literal["certkit-fit/1"], Field(alias="schema")] = "certkit-fit/1"
    fit: str
    title: str
    legform: str
    runs: int
    rms_before: Figure
    rms_after: Figure
    passes: Annotated[
        bool | None, Field(description="Whether every graded criterion passes; null where nothing is graded.")
    ]
    values: list[FittedValue]
    curves: Annotated[list[FollowedCurve], Field(default_factory=list)]
    parameters: list[FittedParameter]
    correlations: list[StrongCorrelation]
    open_directions: list[OpenDirection]
    basins: Annotated[list[ReachedBasin], Field(default_factory=list, description="Of other searches.")]
    nearer_elsewhere: Annotated[
        bool, Field(description="True: one of the other searches came nearer than this fit.")
    ] = False
    family: FamilyFigures | None = None
    certkit: str = ""
