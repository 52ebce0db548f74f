"""`calibrate`: fit the free numbers of a legform and its rigs to tests, and write the fitted files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from certkit.definitions.loading.library import folders_of
from certkit.errors import UsageError
from certkit.studies.calibration import fit
from certkit.studies.calibration.run_calibration import fit_and_write
from certkit.studies.execution import Execution
from certkit.studies.journal import JOURNAL, forget

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.calibration import CalibrationTask
    from certkit.studies.calibration.search import Tell
    from certkit.studies.dask_cluster import ClusterAddress


def calibrate(  # noqa: PLR0913  # as many as the command has options
    document: CalibrationTask | str | Path,
    *,
    out: str | Path | None = None,
    family: int | None = None,
    fresh: bool = False,
    library: str | Path | Sequence[str | Path] = (),
    processes: int | None = None,
    cluster: str | ClusterAddress | None = None,
    tell: Tell = lambda _: None,
    force: bool = False,
) -> fit.Calibration:
    """Fit parameters of a legform and of rigs to tests, within bounds.

    Parameters
    ----------
    document : CalibrationTask, str or Path
        The fit, its shipped name, or its file.
    out : str or Path, optional
        Folder for the fitted legform and rigs and the report; a fit that was interrupted goes on from what is
        there. Nothing is written when missing.
    family : int, optional
        Also find and write this many legs that pass every graded criterion; needs `out`.
    fresh : bool
        Forget the runs that an earlier call has done.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first.
    processes : int, optional
        Workers on this machine, all cores by default.
    cluster : str or ClusterAddress, optional
        Address of a Dask scheduler to use instead.
    tell : callable, optional
        Told how far the search has come.
    force : bool
        Write over another fit in the folder.

    Returns
    -------
    Calibration
        `point` has the fitted numbers, `report` is its document and `files` what was
        written, where `out` was given.

    Raises
    ------
    DefinitionError, UsageError
        Before anything is run.
    RunError
        When not even the best place found can be run.
    """
    if family is not None and out is None:
        raise UsageError("a family is written as files; say where with `out`")
    folders = folders_of(library)
    task = fit.make_ready(document, folders)
    execution = Execution(processes, cluster)
    if out is None:
        with fit.runs_for(task, execution) as runs:
            return fit.calibrate(task, runs, tell)
    folder = Path(out)
    if fresh:
        forget(folder / JOURNAL)
    return fit_and_write(task, folder, family=family, execution=execution, tell=tell, force=force)
