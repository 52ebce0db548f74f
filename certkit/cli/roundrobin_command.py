"""`certkit roundrobin`: how well laboratories agree."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # typer reads the annotations

Certificates = Annotated[
    list[Path],
    typer.Argument(
        metavar="CERTIFICATE", help="report.pdf or result.json of a measured test, or the folder of its run."
    ),
]


def roundrobin(
    certificates: Certificates,
    *,
    without: Annotated[
        list[str] | None,
        typer.Option("--without", metavar="LABORATORY", help="Leave one out; the page says so. Repeatable."),
    ] = None,
    title: Annotated[str, typer.Option("--title", metavar="WORDS", help="Of the page.")] = "Round robin",
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for the results.", show_default="runs/round-robin")
    ] = None,
    formats: Annotated[
        str, typer.Option("--format", help=options.reports_help("certkit-round-robin/1"))
    ] = "html",
    force: options.Force = False,
    unverified: options.Unverified = False,
    as_json: options.AsJson = False,
) -> None:
    """Draw up repeatability, reproducibility and z-scores of certificates from several laboratories.

    By ISO 5725-2 and ISO 13528, of each criterion that two laboratories have values of. Every certificate is
    graded again first. Exit code 1 when a laboratory is an outlier.
    """
    from certkit.bench.render_documents import reports_of  # noqa: PLC0415  # numpy waits
    from certkit.bench.round_robin import round_robin  # noqa: PLC0415  # likewise
    from certkit.cli.console import render_and_tell  # noqa: PLC0415  # likewise
    from certkit.documents.round_robin_report import RoundRobinReport  # noqa: PLC0415  # likewise
    from certkit.reporting.round_robin_page import round_robin_text  # noqa: PLC0415  # likewise

    wanted = reports_of(RoundRobinReport, formats)
    document = round_robin(certificates, without=without or (), title=title, unverified=unverified)
    render_and_tell(
        document, round_robin_text(document), out, "round-robin", wanted, force=force, as_json=as_json
    )
    raise typer.Exit(1 if document.outliers else 0)
