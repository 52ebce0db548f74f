"""What a leg's recordings tell of its parts, as a document (schema `certkit-twin/1`)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.rounding import Figure, Figures
from certkit.reasons import Reason

Answer = Literal["nothing deviates", "one part", "several parts would do", "no part explains it"]


class PartFinding(Part):
    """How well a change of one part alone explains the recording."""

    part: str
    change: Annotated[Figure, Field(description="In `unit`: % of its value, or by how much it is moved.")]
    unit: str
    lower: Annotated[Figure, Field(description="95 % interval of the change.")]
    upper: Figure
    misfit: Annotated[
        Figure, Field(description="χ² that is left per sample; 1 is what sensors and time zero explain.")
    ]
    explained: Annotated[Figure, Field(description="Share of the deviation's χ² that it takes away.")]
    candidate: Annotated[bool, Field(description="The best one, or not to be told from it.")]
    remedy: str


class TwinCurve(Part):
    """A channel at the places that were compared: recorded, of the model, and with the best part changed."""

    channel: str
    title: str
    unit: str
    time: Annotated[Figures, Field(description="s after contact")]
    recorded: Figures
    model: Figures
    changed: Figures


class TwinTest(Part):
    """What one recording tells."""

    id: str
    procedure: str
    day: str
    serial: str
    answer: Answer
    misfit: Annotated[Figure, Field(description="χ² per sample of the model with nothing changed.")]
    samples: int
    findings: Annotated[list[PartFinding], Field(description="Best first.")]
    curves: list[TwinCurve]


class TwinReport(OutputDocument):
    """Which part of a leg, or setting of its rig, explains how its recordings differ."""

    noun: ClassVar = "twin"
    file_name: ClassVar = "twin.json"
    made_by: ClassVar = "certkit twin"

    schema_: Annotated[Literal["certkit-twin/1"], Field(alias="schema")] = "certkit-twin/1"
    diagnosis: str
    title: str
    legform: str
    against: Annotated[str, Field(description="Certificate that the recordings are compared with, or none.")]
    tests: list[TwinTest]
    remarks: list[str] = []
    coded_remarks: list[Reason] = []
    certkit: str = ""
