"""`certkit study`: sweeps, sensitivity, scatter of tests, optimisation."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations
from certkit.cli.many_runs import Cluster, Fresh, Processes, TlsCa, TlsCert, TlsKey, cluster_address

Document = Annotated[str, typer.Argument(metavar="STUDY.yaml", help="The study: a file, or a shipped name.")]
Tables = Annotated[str, typer.Option("--table", help="Tables to write: csv, json, parquet.")]


def study(
    document: Document,
    *,
    out: options.Out = None,
    processes: Processes = None,
    cluster: Cluster = None,
    tls_ca_file: TlsCa = None,
    tls_cert: TlsCert = None,
    tls_key: TlsKey = None,
    table: Tables = "csv,json",
    fresh: Fresh = False,
    force: options.Force = False,
    library: options.Libraries = None,
    as_json: options.AsJson = False,
    quiet: options.Quiet = False,
) -> None:
    """Run procedures many times with values that vary, and say what moves what.

    Writes the table of all runs, the findings as JSON and an HTML page. A study that was interrupted goes
    on where it was. The exit code is 3 when not a single run succeeded.
    """
    from certkit.cli.counting import counting, resumable  # noqa: PLC0415  # waits until a study is run
    from certkit.documents.study_report import StudyReport  # noqa: PLC0415  # likewise
    from certkit.reporting.study_text import optimum_text, study_text  # noqa: PLC0415  # likewise
    from certkit.studies.carry_out_study import study as carry_out  # noqa: PLC0415  # likewise
    from certkit.studies.carry_out_study import study_sheet  # noqa: PLC0415  # likewise
    from certkit.studies.study_documents import report_of  # noqa: PLC0415  # likewise

    sheet = study_sheet(document, tuple(library or ()))
    folder = out or Path("runs") / sheet.study
    with resumable(fresh=fresh), counting(sheet.study, quiet=quiet or as_json) as progress:
        found = carry_out(
            sheet,
            out=folder,
            tables=table,
            fresh=fresh,
            library=library or (),
            processes=processes,
            cluster=cluster_address(cluster, tls_ca_file, tls_cert, tls_key),
            progress=progress,
            force=force,
        )
    report = report_of(found)
    if as_json:
        typer.echo(report.to_json(), nl=False)
    else:
        typer.echo(study_text(report) if isinstance(report, StudyReport) else optimum_text(report))
        page = (folder / report.file_name).with_suffix(".html")
        typer.echo(f"look at {page}; the runs are in {folder / 'table.csv'}", err=True)
    raise typer.Exit(3 if (found.table["error"] != "").all() else 0)
