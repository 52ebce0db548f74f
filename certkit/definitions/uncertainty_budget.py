"""The uncertainty budget of a test bench: how well the rig is set, and how well its sensors measure."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Document
from certkit.definitions.study import Quantity, StudyParameter


class RigTolerance(StudyParameter):
    """A value of rig or legform that is only known within a tolerance; `values` cannot be one."""

    source: Annotated[str, Field(min_length=1, description="Where the tolerance is from.")]

    @model_validator(mode="after")
    def _continuous(self) -> Self:
        if self.values is not None:
            raise ValueError("a tolerance is `uniform`, `normal` or `triangular`; `values` are for studies")
        return self


class SensorUncertainty(Document):
    """What the calibration certificates of sensors say: expanded uncertainties, k = 2, of each by itself."""

    channels: Annotated[list[str], Field(min_length=1, max_length=50)]
    gain: Annotated[str | None, Field(description="Share of the value: `0.8 %`.")] = None
    offset: Annotated[str | None, Field(description="In the channel's unit: `0.5 N·m`.")] = None
    source: Annotated[str, Field(min_length=1)]

    @model_validator(mode="after")
    def _something(self) -> Self:
        if self.gain is None and self.offset is None:
            raise ValueError("give `gain`, `offset` or both")
        return self


class UncertaintyBudget(Document):
    """What the uncertainty of every criterion of one procedure comes from."""

    budget: Annotated[str, Field(description="Its name.")]
    title: str
    procedure: str
    set: Annotated[dict[str, Quantity], Field(description="Values changed in every run, by path.")] = {}
    rig: Annotated[list[RigTolerance], Field(max_length=100)] = []
    sensors: Annotated[list[SensorUncertainty], Field(max_length=100)] = []
    risk: Annotated[
        str, Field(description="Probability of accepting a value that is outside that is to be kept.")
    ] = "2.5 %"
    runs: Annotated[int, Field(ge=50, le=100_000, description="Of the Monte Carlo propagation.")] = 400
    seed: Annotated[int, Field(ge=0)] = 1
    notes: list[str] = []

    @model_validator(mode="after")
    def _fits_together(self) -> Self:
        if not self.rig and not self.sensors:
            raise ValueError("a budget needs tolerances of the `rig`, `sensors`, or both")
        paths = [tolerance.path for tolerance in self.rig]
        twice = sorted({path for path in paths if paths.count(path) > 1})
        if twice:
            raise ValueError(f"the tolerance of `{twice[0]}` stands here twice; keep one of them")
        return self
