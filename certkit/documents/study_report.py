"""`StudyReport`: what a study found, as data that its page is rendered from (schema `certkit-study/1`).

The table of all runs stands in files of its own beside it; the clouds of runs that are drawn are in here.
"""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, model_validator

from certkit.documents.consistent_lists import check_lengths
from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.rounding import Figure, FigureOrWord, Figures, Points


class VariedParameter(Part):
    """A parameter and how it varies, in its unit."""

    name: Annotated[str, Field(description="Its path, with the procedure before it where it is of one only.")]
    unit: str
    nominal: Annotated[FigureOrWord | None, Field(description="Its value in the definitions.")] = None
    distribution: Literal["uniform", "normal", "triangular", "levels"]
    low: Annotated[Figure | None, Field(description="Lowest value; a normal one is cut off there.")] = None
    high: Annotated[Figure | None, Field(description="Highest value, likewise.")] = None
    mode: Annotated[Figure | None, Field(description="Likeliest value of a triangular one.")] = None
    mean: Annotated[Figure | None, Field(description="Mean of a normal one.")] = None
    sd: Annotated[Figure | None, Field(description="Its standard deviation.")] = None
    entries: Annotated[list[FigureOrWord] | None, Field(description="Levels: numbers or words.")] = None


class Effect(Part):
    """By how much a parameter moves an output over its range, in the output's unit."""

    output: str
    factor: str
    effect: Figure
    lower: Annotated[
        Figure | None,
        Field(description="95 % interval; of a one-at-a-time design the lowest setting against the middle."),
    ]
    upper: Annotated[Figure | None, Field(description="Likewise, of the highest setting.")]
    share: Annotated[
        Figure,
        Field(
            description="Variance that it brings along the plane, over that of all parameters and of what "
            "the plane leaves; one at a time: its squared effect over the sum of all."
        ),
    ]


class SensitivityIndex(Part):
    """Morris' (`mean` μ, `strength` μ*, `nonlinearity` σ) or Sobol's (`first`, `total`) of one parameter."""

    output: str
    factor: str
    mean: Figure | None = None
    strength: Figure | None = None
    strength_interval: Figure | None = None
    nonlinearity: Figure | None = None
    first: Figure | None = None
    first_interval: Annotated[Figure | None, Field(description="Half-width at 95 %.")] = None
    total: Figure | None = None
    total_interval: Annotated[Figure | None, Field(description="Half-width at 95 %.")] = None


class QuickModel(Part):
    """A polynomial in the coded factors (−1 lowest, +1 highest)."""

    output: str
    kind: Literal["linear", "quadratic"]
    terms: Annotated[list[str], Field(description="`1`, a factor's name, `A · B` or `A²`.")]
    coefficients: Annotated[Figures, Field(description="One a term, in the output's unit.")]
    error: Annotated[
        Figure,
        Field(description="Root mean square error of predicting each run from all others, output's unit."),
    ]
    explained: Annotated[
        Figure,
        Field(description="Share of the variance predicted so; below 0 it is worse than the mean."),
    ]

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse a polynomial whose terms lack a coefficient."""
        check_lengths(len(self.terms), {"coefficients": self.coefficients}, "terms")
        return self


class Chance(Part):
    """How often a criterion stayed inside; a run in which it was not evaluated counts as outside."""

    criterion: Annotated[str, Field(description="`PROCEDURE/CRITERION`, or `all` for all at once.")]
    inside: int
    runs: int
    probability: Annotated[Figure, Field(description="Share inside.")]
    lower: Annotated[Figure, Field(description="95 % interval after Clopper and Pearson.")]
    upper: Figure
    distance: Annotated[
        Figure | None,
        Field(description="Mean margin in standard deviations of the margin; the smallest fails first."),
    ] = None
    first: Annotated[int, Field(description="Runs in which this criterion is the farthest outside.")]
    unknown: Annotated[
        int, Field(description="Runs that failed, or in which it was not evaluated; they count as outside.")
    ] = 0


class Cloud(Part):
    """Runs as dots, thinned out for drawing, with a line through them."""

    x_name: str
    y_name: str
    x: Figures
    y: Figures
    line: Points = Field(default_factory=list)

    @model_validator(mode="after")
    def _fits(self) -> Self:
        """Refuse a cloud whose dots lack a coordinate."""
        check_lengths(len(self.x), {"y": self.y}, "values of `x`")
        return self


class StudyReport(OutputDocument):
    """What a study with a design found."""

    noun: ClassVar = "study report"
    file_name: ClassVar = "study.json"
    made_by: ClassVar = "certkit study"

    schema_: Annotated[Literal["certkit-study/1"], Field(alias="schema")] = "certkit-study/1"
    study: str
    title: str
    design: str
    runs: int
    failed: Annotated[int, Field(description="Runs that ended with an error.")]
    factors: list[VariedParameter]
    output_units: Annotated[dict[str, str], Field(description="Units of criteria and their margins.")] = (
        Field(default_factory=dict)
    )
    effects: list[Effect]
    indices: list[SensitivityIndex] | None = None
    models: list[QuickModel]
    chances: list[Chance]
    outputs: Annotated[
        list[str], Field(description="Outputs that are told of one by one; numerical quality is not.")
    ] = Field(default_factory=list)
    clouds: Annotated[
        list[Cloud], Field(description="Each output over the parameters that move it most.")
    ] = Field(default_factory=list)
    certkit: str = ""
