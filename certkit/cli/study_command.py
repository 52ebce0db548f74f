"""`certkit study`: sweeps, sensitivity, scatter of tests, optimisation."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations

if TYPE_CHECKING:
    from certkit.studies.dask_cluster import ClusterAddress

Document = Annotated[str, typer.Argument(metavar="STUDY.yaml", help="The study: a file, or a shipped name.")]
Processes = Annotated[
    int | None,
    typer.Option("--processes", min=1, help="Processes on this machine.", show_default="all cores"),
]
Cluster = Annotated[
    str | None,
    typer.Option("--cluster", metavar="ADDRESS", help="Run on the Dask cluster with this scheduler instead."),
]
TlsCa = Annotated[
    Path | None,
    typer.Option("--tls-ca-file", metavar="CA.pem", help="Authority that cluster and we trust (tls://)."),
]
TlsCert = Annotated[
    Path | None, typer.Option("--tls-cert", metavar="CERT.pem", help="Our certificate for the cluster.")
]
TlsKey = Annotated[Path | None, typer.Option("--tls-key", metavar="KEY.pem", help="Its key.")]
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
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Forget the runs that an earlier call has done.")
    ] = False,
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
    with resumable(), counting(sheet.study, quiet=quiet or as_json) as progress:
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


def cluster_address(
    scheduler: str | None, ca_file: Path | None, cert: Path | None, key: Path | None
) -> ClusterAddress | None:
    """Return where the cluster is, and how we prove who we are.

    Raises
    ------
    UsageError
        When the options do not fit together.
    """
    from certkit.errors import UsageError  # noqa: PLC0415  # waits until a study is run
    from certkit.studies.dask_cluster import ClusterAddress  # noqa: PLC0415  # likewise

    if scheduler is None:
        if ca_file or cert or key:
            raise UsageError("TLS is for a cluster; name its scheduler with --cluster tls://HOST:PORT")
        return None
    address = ClusterAddress(scheduler, ca_file, cert, key)
    address.check()
    return address
