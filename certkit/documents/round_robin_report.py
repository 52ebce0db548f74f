"""A round robin as a document (schema `certkit-round-robin/1`): one test at several laboratories."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal, NamedTuple

from pydantic import Field

from certkit.documents.output_document import OutputDocument, Part
from certkit.documents.result import Verdict
from certkit.documents.rounding import Figure, Figures
from certkit.reasons import Reason

if TYPE_CHECKING:
    import pandas as pd

Mark = Literal["", "straggler", "outlier"]


class RoundRobinTest(Part):
    """A certificate that went in."""

    id: str
    laboratory: str
    serial: str
    day: str
    procedure: str
    verdict: Verdict


class LaboratoryRow(Part):
    """One laboratory in one criterion."""

    laboratory: str
    values: Figures
    mean: Figure
    deviation: Annotated[Figure | None, Field(description="Standard deviation of its tests.")] = None
    z: Annotated[Figure | None, Field(description="ISO 13528, robust; 2 is questionable, 3 is too far.")] = (
        None
    )
    h: Annotated[Figure | None, Field(description="Mandel's h, of the mean.")] = None
    k: Annotated[Figure | None, Field(description="Mandel's k, of the scatter.")] = None
    cochran: Annotated[Mark, Field(description="Of its scatter.")] = ""
    grubbs: Annotated[Mark, Field(description="Of its mean.")] = ""

    @property
    def marks(self) -> tuple[tuple[Literal["scatter", "mean"], Mark], ...]:
        """What the tests of its scatter and of its mean found."""
        return ("scatter", self.cochran), ("mean", self.grubbs)


class CriterionPrecision(Part):
    """One criterion over all laboratories, in its unit."""

    procedure: str
    criterion: str
    title: str
    unit: str
    lower: Figure | None = None
    upper: Figure | None = None
    tests: int
    mean: Figure
    repeatability: Annotated[Figure | None, Field(description="s_r: one laboratory again.")] = None
    between: Annotated[Figure | None, Field(description="s_L: the laboratories' own share.")] = None
    reproducibility: Annotated[Figure | None, Field(description="s_R: another laboratory.")] = None
    repeatability_limit: Annotated[Figure | None, Field(description="2.8 s_r.")] = None
    reproducibility_limit: Annotated[Figure | None, Field(description="2.8 s_R.")] = None
    robust_mean: Figure
    robust_deviation: Figure
    rows: list[LaboratoryRow]

    @property
    def key(self) -> str:
        """What it is called among all: `pendulum/T1`."""
        return f"{self.procedure}/{self.criterion}"


class FoundOutlier(NamedTuple):
    """A laboratory that one of the outlier tests found in a criterion."""

    laboratory: str
    criterion: str
    test: Literal["scatter", "mean"]


class RoundRobinReport(OutputDocument):
    """How well laboratories agree in a test."""

    noun: ClassVar = "round robin"
    file_name: ClassVar = "round-robin.json"
    made_by: ClassVar = "certkit roundrobin"

    schema_: Annotated[Literal["certkit-round-robin/1"], Field(alias="schema")] = "certkit-round-robin/1"
    title: str
    laboratories: list[str]
    left_out: Annotated[list[str], Field(description="Laboratories that were asked to be left out.")] = []
    tests: list[RoundRobinTest]
    criteria: list[CriterionPrecision]
    remarks: list[str] = []
    coded_remarks: list[Reason] = []

    @property
    def found_outliers(self) -> list[FoundOutlier]:
        """Laboratory, criterion and test of each outlier."""
        return [
            FoundOutlier(row.laboratory, each.key, what)
            for each in self.criteria
            for row in each.rows
            for what, mark in row.marks
            if mark == "outlier"
        ]

    @property
    def outliers(self) -> list[str]:
        """Each outlier in words: `North in pendulum/T1 (mean)`."""
        return [f"{each.laboratory} in {each.criterion} ({each.test})" for each in self.found_outliers]

    def to_pandas(self) -> pd.DataFrame:
        """Return the precision of each criterion: one row each, values in the unit of the row."""
        import pandas as pd  # noqa: PLC0415  # slow to import, and only tables need it

        names = ("title", "unit", "tests", "mean", "repeatability", "between", "reproducibility")
        rows = [[getattr(each, name) for name in names] for each in self.criteria]
        return pd.DataFrame(rows, index=pd.Index([c.key for c in self.criteria], name="id"), columns=names)
