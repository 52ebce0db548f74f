"""An uncertainty budget as a document (schema `certkit-uncertainty/1`): U and its shares."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.rounding import Figure

BENT = 1.25
"""Times the GUM's U that the runs have to reach for it to count no more: 400 tell it to about a tenth."""


class BudgetLine(Part):
    """One source of uncertainty of one criterion."""

    name: Annotated[str, Field(description="Path of a tolerance; `gain` or `offset` of a sensor.")]
    standard: Annotated[Figure, Field(description="Standard uncertainty u of the source, in its unit.")]
    unit: str
    sensitivity: Annotated[
        Figure | None, Field(description="c, the criterion's unit over the source's; none of a sensor.")
    ] = None
    contribution: Annotated[Figure, Field(description="c·u with its sign, in the criterion's unit.")]
    share: Annotated[Figure, Field(description="(c·u)² over the sum of all.")]


class CriterionUncertainty(Part):
    """What the uncertainty of one criterion is, and comes from; in the criterion's unit."""

    criterion: str
    title: str
    channel: Annotated[str, Field(description="Short name, as in a laboratory file.")]
    unit: str
    value: Annotated[Figure, Field(description="Of the model, with everything as it should be.")]
    lower: Figure | None = None
    upper: Figure | None = None
    expanded: Annotated[Figure, Field(description="U = 2·√Σ(c·u)², by the GUM.")]
    simulated: Annotated[Figure, Field(description="Half the 95 % interval of the Monte Carlo runs.")]
    farthest: Annotated[
        Figure, Field(description="Distance of the farther end of that interval from the value.")
    ] = 0.0
    shift: Annotated[Figure, Field(description="Mean of the Monte Carlo runs less the value.")]
    false_accept: Annotated[Figure | None, Field(description="Of the model's value, with U.")] = None
    guard_band: Annotated[
        Figure | None, Field(description="To be kept from each limit for the wanted risk.")
    ] = None
    allowed: Annotated[
        Figure | None, Field(description="Largest U with which the model's value keeps the wanted risk.")
    ] = None
    tighten: Annotated[str, Field(description="Largest source, where U is more than allowed.")] = ""
    tighten_to: Annotated[
        Figure | None,
        Field(description="Share of its present size that is left to it; none: it alone is not enough."),
    ] = None
    lines: Annotated[list[BudgetLine], Field(description="Largest share first.")]

    @property
    def bent(self) -> bool:
        """Whether the runs leave what the GUM says, which takes the model as straight (JCGM 101, 8)."""
        return self.farthest > BENT * self.expanded

    @property
    def counted(self) -> float:
        """U that counts: the GUM's, or the farther end of the runs' interval where the model is bent."""
        return self.farthest if self.bent else self.expanded


class UncertaintyReport(OutputDocument):
    """The uncertainty of a test, propagated through the model."""

    noun: ClassVar = "uncertainty budget"
    file_name: ClassVar = "uncertainty.json"
    made_by: ClassVar = "certkit uncertainty"

    schema_: Annotated[Literal["certkit-uncertainty/1"], Field(alias="schema")] = "certkit-uncertainty/1"
    budget: str
    title: str
    procedure: str
    risk: Annotated[Figure, Field(description="Probability of false acceptance that is wanted.")]
    runs: int
    failed: Annotated[int, Field(description="Monte Carlo runs that ended with an error; left out.")]
    criteria: list[CriterionUncertainty]
    sources: Annotated[dict[str, str], Field(description="Where each tolerance is from.")]
    notes: list[str] = []
    certkit: str = ""
