"""`study`: carry out a study document over its procedures, and say what it found."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct, field
from msgspec.structs import replace

from certkit.definitions.study import DESIGNS, Study
from certkit.studies.designs import design_of
from certkit.studies.designs.shares import correlation_matrix
from certkit.studies.execution import USUAL, Execution
from certkit.studies.factors import Factor, factor_of
from certkit.studies.run_table import ERROR, RUN, table_of
from certkit.studies.runs import Runs
from certkit.studies.trial import Trial

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pandas as pd

    from certkit.definitions.study import Design
    from certkit.documents.study_report import Chance, QuickModel
    from certkit.studies.points import Point


class Findings(Struct, frozen=True):
    """What a study found.

    Parameters
    ----------
    name, title, design : str
    factors : tuple of Factor
    table : DataFrame
        One row a run; see `certkit.studies.run_table`.
    effects : DataFrame
        Main effects; see `certkit.studies.effects`.
    indices : DataFrame, optional
        Of a Morris or Sobol design.
    models : list of QuickModel
    chances : list of Chance
        Probability of each graded criterion to stay inside, where the design scatters by distribution.
    """

    name: str
    title: str
    design: str
    factors: tuple[Factor, ...]
    table: pd.DataFrame
    effects: pd.DataFrame
    indices: pd.DataFrame | None = None
    models: list[QuickModel] = field(default_factory=list)
    chances: list[Chance] = field(default_factory=list)
    output_units: dict[str, str] = field(default_factory=dict)

    @property
    def units(self) -> dict[str, str]:
        """Units of the factors' columns."""
        return {factor.name: factor.unit for factor in self.factors}

    @property
    def failed(self) -> int:
        """Number of runs that ended with an error."""
        return int((self.table[ERROR] != "").sum())


def study(
    sheet: Study,
    *,
    library: Sequence[Path] = (),
    execution: Execution = USUAL,
) -> Findings:
    """Carry out a study with a design.

    Parameters
    ----------
    sheet : Study
    library : sequence of Path
        Folders with own definitions.
    execution : Execution
        Where and how the runs are done.

    Returns
    -------
    Findings

    Raises
    ------
    UsageError
        When parameters and definitions do not fit together, before anything is run.
    """
    trial, factors = set_up(sheet, library)
    with Runs(trial, execution, context=trial.context) as runs:
        return replace(carry_out(sheet, factors, runs), output_units=trial.output_units())


def set_up(sheet: Study, library: Sequence[Path] = ()) -> tuple[Trial, list[Factor]]:
    """Return a study's evaluation and its factors, after one check that every setting can be loaded."""
    names = tuple(str(Path(folder)) for folder in library)
    bare = Trial(
        tuple(sheet.procedures), fixed={path: str(value) for path, value in sheet.set.items()}, library=names
    )
    nominals = bare.nominals(parameter.name for parameter in sheet.parameters)
    factors = [factor_of(parameter, nominals) for parameter in sheet.parameters]
    trial = replace(bare, units={f.name: f.unit for f in factors})
    middle = {factor.name: factor.middle for factor in factors}
    for procedure in sheet.procedures:
        trial.prepared(procedure, middle)
    return trial, factors


def carry_out(sheet: Study, factors: Sequence[Factor], runs: Runs) -> Findings:
    """Run a study's design with any evaluation and look at what came out."""
    from certkit.studies.quick_model import quick_models  # noqa: PLC0415  # pandas, scipy
    from certkit.studies.scatter import chances  # noqa: PLC0415  # likewise

    design = sheet.design
    if design is None:
        raise TypeError("this study has no design")
    pairs = [(pair.between[0], pair.between[1], pair.coefficient) for pair in sheet.correlations]
    points = points_of(design, factors, pairs)
    table = table_of(points, runs(points))
    outputs = numeric_outputs(table, factors)
    reading = design_of(design.kind)
    return Findings(
        name=sheet.study,
        title=sheet.title,
        design=design.kind,
        factors=tuple(factors),
        table=table,
        effects=reading.effects(table, factors, outputs),
        indices=reading.indices(table, factors, outputs, design.seed),
        models=quick_models(table, factors, outputs) if reading.fits_models else [],
        chances=chances(table) if DESIGNS[design.kind].by_probability else [],
    )


def points_of(
    design: Design, factors: Sequence[Factor], pairs: Sequence[tuple[str, str, float]] = ()
) -> list[Point]:
    """Return the runs of a design."""
    return design_of(design.kind).points(design, factors, correlation_matrix(factors, pairs))


def numeric_outputs(table: pd.DataFrame, factors: Sequence[Factor]) -> list[str]:
    """List the columns that are outputs and numbers; margins are left to the criteria they belong to."""
    inputs = {factor.name for factor in factors} | {RUN, ERROR}
    return [
        str(name)
        for name in table
        if name not in inputs and table[name].dtype.kind == "f" and not str(name).endswith(" margin")
    ]
