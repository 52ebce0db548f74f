"""`OptimumReport`: what an optimisation found, as data for its page (schema `certkit-optimum/1`)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.rounding import Figure, FigureOrWord
from certkit.documents.study_report import Cloud, VariedParameter


class PursuedAim(Part):
    """A value that was to become small, or large."""

    output: str
    direction: Literal["minimise", "maximise"]


class OptimumValue(Part):
    """A value of the best run."""

    name: str
    value: Figure | None
    unit: str


class OptimumReport(OutputDocument):
    """What an optimisation found."""

    noun: ClassVar = "optimisation report"
    file_name: ClassVar = "optimum.json"
    made_by: ClassVar = "certkit study"

    schema_: Annotated[Literal["certkit-optimum/1"], Field(alias="schema")] = "certkit-optimum/1"
    study: str
    title: str
    runs: int
    keeps_all_limits: bool
    slack: Annotated[
        Figure, Field(description="By which part of its limit the tightest criterion is better than needed.")
    ]
    best_run: Annotated[int, Field(description="Row of the table, from 1.")]
    settings: Annotated[list[str], Field(description="The best ones as `path=value`, for `--set`.")]
    factors: list[VariedParameter] = Field(default_factory=list)
    best: Annotated[dict[str, FigureOrWord], Field(description="The best settings in their units.")] = Field(
        default_factory=dict
    )
    outputs: list[OptimumValue] = Field(default_factory=list)
    aims: list[PursuedAim]
    trade_off: Annotated[
        list[dict[str, FigureOrWord]],
        Field(description="Runs that no other beats in both aims: their number and both outputs."),
    ]
    cloud: Annotated[Cloud | None, Field(description="All runs over both aims, with the trade-off.")] = None
    certkit: str = ""
