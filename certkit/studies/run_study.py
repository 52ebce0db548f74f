"""A study from its document to its files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.bench.render_documents import render
from certkit.bench.result_folder import refuse_other_name
from certkit.studies.execution import USUAL, Execution
from certkit.studies.journal import JOURNAL
from certkit.studies.optimise import limits_of, optimise
from certkit.studies.run_table import check_formats, write_table
from certkit.studies.runs import Runs
from certkit.studies.study_documents import optimum_report, study_report
from certkit.studies.study_findings import set_up, study

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from pathlib import Path

    from certkit.definitions.study import Study
    from certkit.studies.optimise import Optimum
    from certkit.studies.study_findings import Findings

FILES = ("study.json", "optimum.json")


def optimum(
    sheet: Study,
    *,
    library: Sequence[Path] = (),
    execution: Execution = USUAL,
) -> Optimum:
    """Carry an optimisation out; the arguments are those of `certkit.studies.study_findings.study`."""
    trial, factors = set_up(sheet, library)
    held = limits_of(trial)
    with Runs(trial, execution, context=trial.context) as runs:
        return replace(optimise(sheet, factors, held, runs), output_units=trial.output_units())


def optimise_and_write(  # as many as the command has options
    sheet: Study,
    folder: Path,
    formats: Collection[str],
    *,
    library: Sequence[Path] = (),
    execution: Execution = USUAL,
    force: bool = False,
) -> Optimum:
    """Carry an optimisation out and write its table, what it found and its page; see `study_and_write`."""
    check_formats(formats)
    refuse_other_name(folder, "study", sheet.study, FILES, force=force)
    found = optimum(sheet, library=library, execution=execution.kept_in(folder / JOURNAL))
    units = {factor.name: factor.unit for factor in found.factors}
    shown = {**units, **found.output_units}
    render(
        optimum_report(found),
        folder,
        force=force,
        beside=lambda stage: write_table(found.table, stage, "table", shown, formats),
    )
    return found


def study_and_write(  # as many as the command has options
    sheet: Study,
    folder: Path,
    formats: Collection[str],
    *,
    library: Sequence[Path] = (),
    execution: Execution = USUAL,
    force: bool = False,
) -> Findings:
    """Carry a study out and write its table, its findings and its page.

    Returns
    -------
    Findings

    Raises
    ------
    UsageError
        When the folder holds another study, and `force` is not given.
    """
    check_formats(formats)
    refuse_other_name(folder, "study", sheet.study, FILES, force=force)
    findings = study(sheet, library=library, execution=execution.kept_in(folder / JOURNAL))
    units = {**findings.units, **findings.output_units}
    render(
        study_report(findings),
        folder,
        force=force,
        beside=lambda stage: write_table(findings.table, stage, "table", units, formats),
    )
    return findings
