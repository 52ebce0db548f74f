"""The diagnosis of a leg: which parts of leg and rig may differ from the model, and by how much."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Document
from certkit.definitions.filters import Filter
from certkit.definitions.provenance import Confidence


class SuspectPart(Document):
    """A part with one number that tells its state: `share` of its values, or `shift` by a length or angle."""

    part: Annotated[str, Field(min_length=1, description="What it is called: `flesh`, `MCL`.")]
    paths: Annotated[
        list[str],
        Field(min_length=1, max_length=20, description="Values that change together, as for `--set`."),
    ]
    usual_share: Annotated[
        str | None,
        Field(description="It is multiplied; by how much it usually differs (standard deviation): `10 %`."),
    ] = None
    usual_shift: Annotated[
        str | None, Field(description="It is moved; by how much it usually is (standard deviation): `3 mm`.")
    ] = None
    procedures: Annotated[
        list[str] | None, Field(description="Where it plays a part; everywhere when missing.")
    ] = None
    remedy: Annotated[str, Field(min_length=1, description="What to do when it is found.")]

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if (self.usual_share is None) == (self.usual_shift is None):
            raise ValueError("give `usual share` or `usual shift`, one of them")
        return self


class Diagnosis(Document):
    """What is looked for in the recordings of a legform, and how well the recordings are known to be."""

    diagnosis: Annotated[str, Field(description="Its name.")]
    title: str
    legform: str
    source: Annotated[str, Field(description="Where the usual amounts and the remedies are from.")]
    confidence: Confidence = "estimated"
    parts: Annotated[list[SuspectPart], Field(min_length=2, max_length=50)]
    conditions: Annotated[
        dict[str, str],
        Field(description="Paths of the rig that take a measured condition's value: `release angle`."),
    ] = {}
    window: Annotated[str, Field(description="Time after contact that is looked at.")] = "60 ms"
    step: Annotated[str, Field(description="Between the places at which curves are compared.")] = "2 ms"
    filter: Filter = "CFC 180"
    gain: Annotated[str, Field(description="Standard uncertainty of a sensor's gain.")] = "0.5 %"
    trigger: Annotated[str, Field(description="Standard uncertainty of time zero.")] = "0.2 ms"
    floor: Annotated[
        str, Field(description="Least standard uncertainty of a sample, as a share of the channel's peak.")
    ] = "0.3 %"
    notes: list[str] = []

    @model_validator(mode="after")
    def _named_once(self) -> Self:
        names = [part.part for part in self.parts]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ValueError(f"the part `{twice[0]}` stands here twice; keep one of them")
        return self
