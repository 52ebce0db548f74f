"""How a finite-element run becomes a virtual test: which histories are channels, which are energies."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from certkit.definitions.base import Document
from certkit.definitions.history_formats import Format
from certkit.definitions.loading.faults import Fault, Faults

Names = Annotated[list[str], Field(min_length=1, max_length=50)]


class History(Document):
    """One history of the run: a column of a tidy table, a variable of solver objects, or two nodes' distance.

    Units follow from the channel and the run's consistent units; of a tidy table, from the end of the
    column's name (`T1_Nm`) or from `unit`.
    """

    column: Annotated[str | None, Field(description="Of a tidy table.")] = None
    unit: Annotated[str | None, Field(description="Of that column, where its name does not end in it.")] = (
        None
    )
    table: Annotated[
        str | None,
        Field(
            description="LS-DYNA: `secforc`, `elout/beam`, `deforc`, `nodout`, `rcforc` …; OpenRadioss: "
            "`section`, `beam`, `spring`, `node`, `contact`."
        ),
    ] = None
    of: Annotated[
        str | list[str] | None,
        Field(description="Title or id of the object; of several, the sum or the mean is taken."),
    ] = None
    variable: Annotated[str | None, Field(description="As the solver calls it: `y_moment`, `M2`.")] = None
    combine: Annotated[Literal["sum", "mean"], Field(description="What several objects become.")] = "sum"
    between: Annotated[
        list[str] | None,
        Field(min_length=2, max_length=2, description="Two nodes: how much their distance grows."),
    ] = None
    sign: Annotated[Literal[1, -1], Field(description="-1 turns the model's polarity into certkit's.")] = 1

    @property
    def objects(self) -> list[str]:
        """Return the objects that are combined."""
        return [self.of] if isinstance(self.of, str) else list(self.of or [])

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        ways = {"column": self.column, "table": self.table, "between": self.between}
        given = [name for name, value in ways.items() if value is not None]
        if len(given) != 1:
            raise Faults([((), "needs one of `column`, `table` (with `of` and `variable`) and `between`")])
        missing = [key for key in ("of", "variable") if getattr(self, key) is None]
        if self.table is not None and missing:
            raise Faults([((), f"a variable of a table needs `{missing[0]}` too")])
        return self


class LegformModel(Document):
    """The finite-element model of the legform, which has to have passed its own certification tests."""

    name: Annotated[str, Field(min_length=1, description="Maker, model and version.")]
    certification: Annotated[
        str | None, Field(min_length=3, description="Report or certificate of the model's own tests.")
    ] = None


Columns = Annotated[list[str], Field(min_length=1, max_length=20)]


class EnergyColumns(Document):
    """Columns of a tidy table that hold the run's energies; of several, the sum is taken.

    Of LS-DYNA's `glstat` and OpenRadioss' global variables nothing needs to be said.
    """

    total: Annotated[
        Columns | None, Field(description="All that is conserved, external work not taken off.")
    ] = None
    ratio: Annotated[
        str | None, Field(description="Total energy over what went in, where the file has it.")
    ] = None
    kinetic: Columns | None = None
    internal: Columns | None = None
    hourglass: Columns | None = None
    contact: Columns | None = None
    external_work: Columns | None = None
    mass: Annotated[
        str | None, Field(description="Mass of the model over time: it grows with mass scaling.")
    ] = None


class FiniteElements(Document):
    """The solver's files of a run and what in them is which channel."""

    format: Annotated[Format | None, Field(description="Told by the file itself when missing.")] = None
    files: Annotated[
        list[str],
        Field(max_length=50, description="Names or patterns in the run's folder, such as `binout*`."),
    ] = []
    units: Annotated[str, Field(description="Mass, length and time, such as `kg mm ms`.")] = "kg mm ms"
    time: Annotated[str, Field(description="Column of the time in a tidy table.")] = "time_ms"
    legform_model: LegformModel
    vehicle: Annotated[str, Field(description="What was hit, for the report.")] = ""
    channels: Annotated[dict[str, History], Field(min_length=1, max_length=200)]
    energies: EnergyColumns = EnergyColumns()
    speed: Annotated[
        History | None, Field(description="Velocity whose amount just before contact is the impact speed.")
    ] = None

    @model_validator(mode="after")
    def _tidy_or_solver(self) -> Self:
        faults: list[Fault] = []
        for name, history in self.channels.items():
            if self.format == "tidy csv" and history.column is None:
                faults.append((("channels", name), "a tidy table has columns; name the `column`"))
            elif self.format not in {None, "tidy csv"} and history.column is not None:
                faults.append(
                    (
                        ("channels", name, "column"),
                        "a solver's file has tables, no columns; map `table`, `of` and `variable`",
                    )
                )
        if faults:
            raise Faults(faults)
        return self
