"""A study from its document to its files."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING

from certkit.files import write_whole
from certkit.studies.optimise import limits_of, optimise
from certkit.studies.run_table import check_formats, write_table
from certkit.studies.runs import Runs
from certkit.studies.study_findings import set_up, study
from certkit.studies.study_pages import optimum_page, study_page

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from pathlib import Path

    from certkit.definitions.study import Study
    from certkit.studies.optimise import Optimum
    from certkit.studies.runs import Progress
    from certkit.studies.study_findings import Findings

JOURNAL = "runs.jsonl"


def optimum(
    sheet: Study,
    *,
    library: Sequence[Path] = (),
    journal: Path | None = None,
    processes: int | None = None,
    cluster: str | None = None,
    progress: Progress | None = None,
) -> Optimum:
    """Carry an optimisation out; the arguments are those of `certkit.studies.study_findings.study`."""
    trial, factors = set_up(sheet, library)
    held = limits_of(trial)
    with Runs(
        trial,
        context=trial.context,
        journal=journal,
        processes=processes,
        cluster=cluster,
        progress=progress,
    ) as runs:
        return replace(optimise(sheet, factors, held, runs), output_units=trial.output_units())


def optimise_and_write(
    sheet: Study,
    folder: Path,
    formats: Collection[str],
    *,
    library: Sequence[Path] = (),
    processes: int | None = None,
    cluster: str | None = None,
    progress: Progress | None = None,
) -> tuple[Optimum, str]:
    """Carry an optimisation out and write its table, what it found and its page; see `carry_and_write`."""
    check_formats(formats)
    found = optimum(
        sheet,
        library=library,
        journal=folder / JOURNAL,
        processes=processes,
        cluster=cluster,
        progress=progress,
    )
    units = {factor.name: factor.unit for factor in found.factors}
    write_table(found.table, folder, "table", {**units, **found.output_units}, formats)
    text = json.dumps(found.document(), ensure_ascii=False, indent=1, allow_nan=False) + "\n"
    write_whole(folder / "optimum.json", text)
    write_whole(folder / "optimum.html", optimum_page(found))
    return found, text


def carry_and_write(
    sheet: Study,
    folder: Path,
    formats: Collection[str],
    *,
    library: Sequence[Path] = (),
    processes: int | None = None,
    cluster: str | None = None,
    progress: Progress | None = None,
) -> tuple[Findings, str]:
    """Carry a study out and write its table, its findings and its page.

    Returns
    -------
    Findings
    str
        The findings as JSON text.
    """
    check_formats(formats)
    findings = study(
        sheet,
        library=library,
        journal=folder / JOURNAL,
        processes=processes,
        cluster=cluster,
        progress=progress,
    )
    write_table(findings.table, folder, "table", {**findings.units, **findings.output_units}, formats)
    text = json.dumps(findings.document(), ensure_ascii=False, indent=1, allow_nan=False) + "\n"
    write_whole(folder / "study.json", text)
    write_whole(folder / "study.html", study_page(findings))
    return findings, text
