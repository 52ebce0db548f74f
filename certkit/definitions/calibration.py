"""The fit document: which numbers of a leg and its rigs are free, and what they are fitted to."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Document
from certkit.definitions.filters import Filter
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.procedure import Curve


class Prior(Document):
    """What was known of a parameter before the fit: a pull towards `mean` with strength 1/`sd`."""

    mean: str
    sd: str


class FitParameter(Document):
    """A number that is free, with the bounds beyond which it would make no physical sense."""

    path: Annotated[str, Field(description="`legform.…`, or a path in the rig of `procedure`.")]
    procedure: Annotated[str | None, Field(description="The procedure whose rig it belongs to.")] = None
    with_: Annotated[
        list[str], Field(description="Paths that always take the same value, such as the LCL's.")
    ] = []
    opposite: Annotated[
        list[str], Field(description="Paths that always take the value with the other sign.")
    ] = []
    lower: str
    upper: str
    scale: Annotated[
        Literal["linear", "logarithmic"], Field(description="How steps are measured between the bounds.")
    ] = "linear"
    prior: Prior | None = None
    reason: Annotated[str, Field(min_length=3, description="Why these bounds.")]

    @property
    def name(self) -> str:
        """Return the path, with the procedure before it where there is one."""
        return f"{self.procedure}/{self.path}" if self.procedure else self.path


class Target(Document):
    """A procedure and what its values should come to."""

    procedure: str
    to: Annotated[
        Literal["corridors", "reference", "recording"],
        Field(
            description="Mid-points of the corridors, in half-widths, the procedure's reference values, or "
            "curves of a recording."
        ),
    ] = "corridors"
    criteria: Annotated[
        list[str] | None, Field(description="Ids; all that are graded, or all in the reference, if missing.")
    ] = None
    tolerance: Annotated[
        str,
        Field(
            description="Deviation that counts as 1: from a reference value, of rms or peak in per cent of "
            "the recorded peak, or of an ISO/TS 18571 score from one."
        ),
    ] = "5 %"
    weight: Annotated[float, Field(gt=0)] = 1.0
    recording: Annotated[
        str | None,
        Field(description="Measured or computed: CSV, ISO-MME or a result, beside the fit's file."),
    ] = None
    mapping: Annotated[str | None, Field(description="How to read it, beside the fit's file.")] = None
    channels: Annotated[
        list[str] | None, Field(min_length=1, description="Curves over time: channels of the recording.")
    ] = None
    curve: Annotated[Curve | None, Field(description="One curve of a channel over another instead.")] = None
    measure: Annotated[
        Literal["rms", "peak", "ISO/TS 18571"],
        Field(description="What should become small: rms or peak deviation, or what the score lacks to one."),
    ] = "rms"
    filter: Annotated[Filter, Field(description="Of recorded and simulated curves.")] = "none"
    contact: Annotated[str, Field(description="Time of first contact in the recording.")] = "0 ms"
    window: Annotated[
        list[str] | None,
        Field(min_length=2, max_length=2, description="What counts: after contact, or of the curve's x."),
    ] = None
    points: Annotated[
        int, Field(ge=5, le=1000, description="Places in the window at which the search sees a curve.")
    ] = 40

    @model_validator(mode="after")
    def _aims_at_one_thing(self) -> Self:
        recorded = self.to == "recording"
        faults: list[Fault] = []
        if recorded and self.recording is None:
            faults.append((("to",), "the file is missing; name it with `recording`"))
        if recorded and (self.channels is None) == (self.curve is None):
            faults.append((("to",), "name either `channels` (over time) or a `curve`"))
        if self.curve is not None and self.measure == "ISO/TS 18571":
            faults.append((("measure",), "ISO/TS 18571 rates curves over time; take `rms` for this curve"))
        if not recorded and self.recording is not None:
            faults.append((("recording",), "it is not looked at; write `to: recording`"))
        if recorded and self.criteria is not None:
            faults.append(
                (
                    ("criteria",),
                    (
                        "a recording is aimed at by `channels` or a `curve`, not by criteria"
                        "; leave `criteria` out"
                    ),
                )
            )
        if faults:
            raise Faults(faults)
        return self


class Search(Document):
    """How the best values are looked for: everywhere first, then downhill."""

    seed: Annotated[int, Field(ge=0)] = 1
    start: Annotated[
        Literal["definitions", "anywhere"],
        Field(description="`definitions` begins at the values now; `anywhere` also takes the best basin."),
    ] = "definitions"
    basins: Annotated[
        int,
        Field(ge=0, le=1000, description="Further searches, each from the best of places spread evenly."),
    ] = 0
    population: Annotated[int, Field(ge=5, le=10_000)] = 24
    generations: Annotated[int, Field(ge=0, le=100_000, description="Of the global search.")] = 100
    pull: Annotated[
        float,
        Field(ge=0, le=1, description="Of every parameter without a prior to the middle of its bounds."),
    ] = 0.2
    steps: Annotated[int, Field(ge=0, le=1000, description="Of the least squares after it, at most.")] = 30
    leave_one_out: Annotated[
        bool, Field(description="Also fit without each value in turn, to see how well the others predict it.")
    ] = False


class FamilySearch(Document):
    """How legs that pass as well are looked for: one walk a member, each from elsewhere to elsewhere."""

    seed: Annotated[int, Field(ge=0)] = 100
    starts: Annotated[
        str | None,
        Field(description="A family whose legs the walks also begin at, such as what other searches found."),
    ] = None
    within: Annotated[
        float,
        Field(ge=0, lt=1, description="Half-widths of the corridors within which each member has its aims."),
    ] = 0.75
    steps: Annotated[int, Field(ge=1, le=1000, description="Of each walk, at most.")] = 15


class CalibrationTask(Document):
    """A calibration: its result is a legform file whose numbers name this fit as their source."""

    fit: Annotated[str, Field(description="Its name.")]
    title: str
    legform: Annotated[str, Field(description="The legform that is fitted: start, and everything fixed.")]
    parameters: Annotated[list[FitParameter], Field(min_length=1, max_length=200)]
    targets: Annotated[list[Target], Field(min_length=1, max_length=50)]
    search: Search = Search()
    family: FamilySearch = FamilySearch()
    notes: list[str] = []

    @model_validator(mode="after")
    def _fits_together(self) -> CalibrationTask:
        names = [parameter.name for parameter in self.parameters]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ValueError(f"the parameter `{twice[0]}` stands here twice; keep one of them")
        strangers = sorted(
            {p.procedure for p in self.parameters if p.procedure} - {t.procedure for t in self.targets}
        )
        if strangers:
            raise ValueError(
                f"`{strangers[0]}` has parameters but is no target of this fit"
                "; add it to the targets, or leave its parameters out"
            )
        unscoped = [p.path for p in self.parameters if not p.procedure and not p.path.startswith("legform.")]
        if unscoped:
            raise ValueError(f"`{unscoped[0]}` is no number of the legform; name its `procedure`")
        return self
