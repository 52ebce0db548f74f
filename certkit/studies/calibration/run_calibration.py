"""A fit from its task to its files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.bench.render_documents import render
from certkit.bench.result_folder import refuse_other_name
from certkit.studies.calibration.fit import calibrate, runs_for
from certkit.studies.calibration.fitted_files import report, write_family, write_fit
from certkit.studies.calibration.leg_family import find_members

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.documents.calibration_report import CalibrationReport
    from certkit.studies.calibration.fit import Calibration, Task
    from certkit.studies.calibration.search import Tell

JOURNAL = "runs.jsonl"


def carry_and_write(
    task: Task,
    folder: Path,
    *,
    family: int | None = None,
    processes: int | None = None,
    cluster: str | None = None,
    tell: Tell = lambda _: None,
    force: bool = False,
) -> tuple[list[Path], CalibrationReport]:
    """Calibrate, find relatives where wanted, and write everything.

    Returns
    -------
    list of Path
        Files written: the legform, rigs that were fitted, `fit.json`, `fit.html`, `families/LEGFORM.yaml`.
    CalibrationReport
    """
    _, document, paths = fit_and_write(
        task, folder, family=family, processes=processes, cluster=cluster, tell=tell, force=force
    )
    return paths, document


def fit_and_write(
    task: Task,
    folder: Path,
    *,
    family: int | None = None,
    processes: int | None = None,
    cluster: str | None = None,
    tell: Tell = lambda _: None,
    force: bool = False,
) -> tuple[Calibration, CalibrationReport, list[Path]]:
    """Calibrate and write; return what was found, its report and the files, as `carry_and_write`.

    Raises
    ------
    UsageError
        When the folder holds another fit, and `force` is not given.
    """
    refuse_other_name(folder, "fit", task.sheet.fit, ["fit.json"], force=force)
    with runs_for(task, journal=folder / JOURNAL, processes=processes, cluster=cluster) as runs:
        found = calibrate(task, runs, tell)
        members = find_members(found, runs, family, tell) if family else None
    document = report(found, members)

    def beside(stage: Path) -> list[Path]:
        paths = write_fit(found, stage)
        if members is not None:
            paths.append(stage / "families" / f"{task.sheet.legform}.yaml")
            write_family(found, members, paths[-1])
        return paths

    return found, document, render(document, folder, force=force, beside=beside)
