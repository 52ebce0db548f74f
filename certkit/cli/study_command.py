"""`certkit study`: sweeps, sensitivity, scatter of tests, optimisation."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations

Document = Annotated[str, typer.Argument(metavar="STUDY.yaml", help="The study: a file, or a shipped name.")]
Processes = Annotated[
    int | None,
    typer.Option("--processes", min=1, help="Processes on this machine.", show_default="all cores"),
]
Cluster = Annotated[
    str | None,
    typer.Option("--cluster", metavar="ADDRESS", help="Run on the Dask cluster with this scheduler instead."),
]
Tables = Annotated[str, typer.Option("--table", help="Tables to write: csv, json, parquet.")]


def study(
    document: Document,
    *,
    out: options.Out = None,
    processes: Processes = None,
    cluster: Cluster = None,
    table: Tables = "csv,json",
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Forget the runs that an earlier call has done.")
    ] = False,
    library: options.Libraries = None,
    as_json: options.AsJson = False,
    quiet: options.Quiet = False,
) -> None:
    """Run procedures many times with values that vary, and say what moves what.

    Writes the table of all runs, the findings as JSON and an HTML page. A study that was interrupted goes
    on where it was. The exit code is 3 when not a single run succeeded.
    """
    from certkit.cli.counting import counting, resumable  # noqa: PLC0415  # waits until a study is run
    from certkit.definitions.loading.library import load  # noqa: PLC0415  # likewise
    from certkit.definitions.study import Study  # noqa: PLC0415  # likewise
    from certkit.studies.journal import forget  # noqa: PLC0415  # likewise
    from certkit.studies.run_study import carry_and_write, optimise_and_write  # noqa: PLC0415  # likewise

    shelves = tuple(library or ())
    sheet = load("study", document, library=shelves).document
    if not isinstance(sheet, Study):
        raise TypeError("not a study")
    folder = out or Path("runs") / sheet.study
    if fresh:
        forget(folder / "runs.jsonl")
    formats = [word.strip() for word in table.split(",") if word.strip()]
    carry = optimise_and_write if sheet.optimise else carry_and_write
    with resumable(), counting(sheet.study, quiet=quiet or as_json) as progress:
        found, text = carry(
            sheet, folder, formats, library=shelves, processes=processes, cluster=cluster, progress=progress
        )
    typer.echo(text if as_json else found.words(), nl=not as_json)
    if not as_json:
        typer.echo(f"table and report in {folder}", err=True)
    raise typer.Exit(3 if (found.table["error"] != "").all() else 0)
