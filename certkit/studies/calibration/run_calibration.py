"""A fit from its task to its files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.bench.render_documents import render
from certkit.bench.result_folder import refuse_other_name
from certkit.studies.calibration.fit import calibrate, runs_for
from certkit.studies.calibration.fitted_files import report, write_family, write_fit
from certkit.studies.calibration.leg_family import find_members
from certkit.studies.execution import USUAL, Execution
from certkit.studies.journal import JOURNAL

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.studies.calibration.fit import Calibration, Task
    from certkit.studies.calibration.search import Tell


def fit_and_write(
    task: Task,
    folder: Path,
    *,
    family: int | None = None,
    execution: Execution = USUAL,
    tell: Tell = lambda _: None,
    force: bool = False,
) -> Calibration:
    """Calibrate, find a family of legs where one is wanted, and write everything.

    Parameters
    ----------
    task : Task
        From `make_ready`.
    folder : Path
        Made when missing.
    family : int, optional
        How many further legs that pass every graded criterion to find.
    execution : Execution
        Where and how runs are done; finished ones are kept in the folder.
    tell : callable
        Told how far the search has come.
    force : bool
        Write over another fit.

    Returns
    -------
    Calibration
        With its report, and the files written: the legform, rigs that were fitted, `fit.json`, `fit.html`,
        `families/LEGFORM.yaml`.

    Raises
    ------
    UsageError
        When the folder holds another fit, and `force` is not given.
    """
    refuse_other_name(folder, "fit", task.sheet.fit, ["fit.json"], force=force)
    with runs_for(task, execution.kept_in(folder / JOURNAL)) as runs:
        found = calibrate(task, runs, tell)
        members = find_members(found, runs, family, tell) if family else None
    document = report(found, members)

    def beside(stage: Path) -> list[Path]:
        paths = write_fit(found, stage)
        if members is not None:
            paths.append(stage / "families" / f"{task.sheet.legform}.yaml")
            write_family(found, members, paths[-1])
        return paths

    paths = render(document, folder, force=force, beside=beside)
    return replace(found, report=document, files=tuple(paths))
