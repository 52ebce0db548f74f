"""`study`: carry out a study, a design or an optimisation, and write its table, findings and page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from certkit.definitions.loading.library import folders_of, load
from certkit.studies import study_findings
from certkit.studies.execution import Execution
from certkit.studies.journal import JOURNAL, forget
from certkit.studies.run_study import optimise_and_write, optimum, study_and_write

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.study import Study
    from certkit.studies.dask_cluster import ClusterAddress
    from certkit.studies.execution import Progress
    from certkit.studies.optimise import Optimum
    from certkit.studies.study_findings import Findings


def study(  # noqa: PLR0913  # as many as the command has options
    document: Study | str | Path,
    *,
    out: str | Path | None = None,
    tables: str | Sequence[str] = ("csv", "json"),
    fresh: bool = False,
    library: str | Path | Sequence[str | Path] = (),
    processes: int | None = None,
    cluster: str | ClusterAddress | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Findings | Optimum:
    """Carry out a study.

    Parameters
    ----------
    document : Study, str or Path
        The study, its shipped name, or its file.
    out : str or Path, optional
        Folder for the table of runs, the findings as JSON and the page; a study that was interrupted goes on
        from what is there. Nothing is written when missing.
    tables : str or sequence of str
        Formats of the table: `csv`, `json`, `parquet`.
    fresh : bool
        Forget the runs that an earlier call has done.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first.
    processes : int, optional
        Workers on this machine, all cores by default.
    cluster : str or ClusterAddress, optional
        Address of a Dask scheduler to use instead.
    progress : callable, optional
        Told of every finished run: done, total, failed.
    force : bool
        Replace what `out` holds of another study.

    Returns
    -------
    Findings or Optimum
        `table` has one row a run.

    Raises
    ------
    DefinitionError, UsageError
        Before anything is run.
    """
    folders = folders_of(library)
    sheet = study_sheet(document, folders)
    execution = Execution(processes, cluster, progress)
    if out is None:
        search = optimum if sheet.optimise else study_findings.study
        return search(sheet, library=folders, execution=execution)
    folder = Path(out)
    if fresh:
        forget(folder / JOURNAL)
    formats = tables.split(",") if isinstance(tables, str) else tables
    write = optimise_and_write if sheet.optimise else study_and_write
    return write(
        sheet,
        folder,
        [word.strip() for word in formats if word.strip()],
        library=folders,
        execution=execution,
        force=force,
    )


def study_sheet(document: Study | str | Path, library: Sequence[Path] = ()) -> Study:
    """Return the study that is given, named or in a file."""
    return (
        load("study", document, library=library).document if isinstance(document, (str, Path)) else document
    )
