"""The study document: which values of which procedures vary, how, how often, and what is wanted from it."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Struct
from pydantic import Field, model_validator

from certkit.definitions.base import Document

Quantity = str | float


class Normal(Document):
    """A normal distribution, cut off at three standard deviations."""

    mean: Quantity | None = None
    sd: Annotated[Quantity, Field(description="Standard deviation: a quantity, or a share such as `2 %`.")]


class StudyParameter(Document):
    """A value that varies, and how. One of `uniform`, `normal`, `triangular`, `values`."""

    path: Annotated[str, Field(description="As for `--set`: `rig.ram.speed`, `legform.flesh.across`.")]
    procedure: Annotated[
        str | None, Field(description="Only in this procedure, where a study has several.")
    ] = None
    uniform: Annotated[
        list[Quantity] | str | None,
        Field(description="Lowest and highest, or a share around the defined value such as `10 %`."),
    ] = None
    normal: Normal | None = None
    triangular: Annotated[
        list[Quantity] | None, Field(min_length=3, max_length=3, description="Lowest, likeliest, highest.")
    ] = None
    values: Annotated[list[Quantity] | None, Field(min_length=2, max_length=1000)] = None

    @model_validator(mode="after")
    def _one_way(self) -> StudyParameter:
        ways = [self.uniform, self.normal, self.triangular, self.values]
        if sum(way is not None for way in ways) != 1:
            raise ValueError("say how it varies, in one way: uniform, normal, triangular or values")
        if isinstance(self.uniform, list) and len(self.uniform) != 2:
            raise ValueError("`uniform` is the lowest and the highest value, or a share such as `10 %`")
        return self

    @property
    def name(self) -> str:
        """Return the path, with the procedure before it where there is one: the table's column."""
        return f"{self.procedure}/{self.path}" if self.procedure else self.path


class Correlation(Document):
    """Two parameters that vary together."""

    between: Annotated[list[str], Field(min_length=2, max_length=2)]
    coefficient: Annotated[float, Field(gt=-1, lt=1)]


class DesignKind(Struct, frozen=True):
    """What follows from a design for the rest of a study.

    Parameters
    ----------
    by_probability : bool
        Whether its runs are spread by the parameters' distributions: it needs `runs`, parameters may vary
        together, and the shares of runs inside the corridors are probabilities.
    from_middle : bool
        Whether the two values beside an effect are those at the lowest and at the highest setting, against
        the middle; else they bound its 95 % interval.
    """

    by_probability: bool = False
    from_middle: bool = False


DESIGNS = MappingProxyType(
    {
        "one at a time": DesignKind(from_middle=True),
        "full factorial": DesignKind(),
        "latin hypercube": DesignKind(by_probability=True),
        "sobol sequence": DesignKind(by_probability=True),
        "morris": DesignKind(),
        "sobol indices": DesignKind(),
    }
)
"""A new design is one line here and one file in `certkit.studies.designs`, found by these words."""

if TYPE_CHECKING:
    DesignWord = str
else:
    DesignWord = Literal[tuple(DESIGNS)]


class Design(Document):
    """Where the runs are put."""

    kind: DesignWord
    runs: Annotated[int | None, Field(ge=1, le=1_000_000, description="Of a hypercube or sequence.")] = None
    levels: Annotated[int, Field(ge=2, le=100, description="Of a factorial or one at a time.")] = 3
    trajectories: Annotated[int, Field(ge=2, le=10_000, description="Of a Morris screening.")] = 20
    samples: Annotated[int, Field(ge=4, le=1_000_000, description="Base samples for Sobol indices.")] = 256
    seed: Annotated[int, Field(ge=0)] = 1

    @model_validator(mode="after")
    def _sized(self) -> Design:
        if DESIGNS[self.kind].by_probability and self.runs is None:
            raise ValueError(f"a {self.kind} needs `runs`: how many")
        return self


class Aim(Document):
    """A value that should become small, or large."""

    output: Annotated[str, Field(description="`procedure/criterion`, such as `vehicle/MCL`.")]
    direction: Literal["minimise", "maximise"] = "minimise"


class Optimisation(Document):
    """Search for parameters that keep all graded criteria inside with a margin; two aims give a trade-off."""

    margin: Annotated[
        str, Field(description="To be kept from every limit: a share of it such as `10 %`.")
    ] = "0 %"
    aims: Annotated[list[Aim], Field(max_length=2)] = []
    evaluations: Annotated[int, Field(ge=20, le=1_000_000, description="At most.")] = 600
    seed: Annotated[int, Field(ge=0)] = 1


class Study(Document):
    """Many runs of one or several procedures."""

    study: Annotated[str, Field(description="Its name.")]
    title: str
    procedures: Annotated[list[str], Field(min_length=1, max_length=50)]
    set: Annotated[dict[str, Quantity], Field(description="Values changed in every run, by path.")] = {}
    parameters: Annotated[list[StudyParameter], Field(min_length=1, max_length=500)]
    correlations: list[Correlation] = []
    design: Design | None = None
    optimise: Optimisation | None = None
    notes: list[str] = []

    @model_validator(mode="after")
    def _fits_together(self) -> Study:
        names = [parameter.name for parameter in self.parameters]
        twice = sorted({name for name in names if names.count(name) > 1})
        if twice:
            raise ValueError(f"the parameter `{twice[0]}` stands here twice; keep one of them")
        unknown = [name for pair in self.correlations for name in pair.between if name not in names]
        if unknown:
            raise ValueError(
                f"`{unknown[0]}` is correlated but is no parameter of this study"
                "; add it to the parameters, or leave its correlation out"
            )
        if (self.design is None) == (self.optimise is None):
            raise ValueError("a study has either a `design` or something to `optimise`")
        if self.correlations and (self.design is None or not DESIGNS[self.design.kind].by_probability):
            able = " or ".join(kind for kind, design in DESIGNS.items() if design.by_probability)
            raise ValueError(f"correlated parameters need the design {able}")
        strangers = [p.procedure for p in self.parameters if p.procedure not in {None, *self.procedures}]
        if strangers:
            raise ValueError(
                f"`{strangers[0]}` is no procedure of this study; add it to `procedures`, or correct the name"
            )
        return self
