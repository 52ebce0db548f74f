"""`certkit history`: the logbook of each legform."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations

app = typer.Typer(
    no_args_is_help=True,
    help=(
        "Keep a logbook by serial number: tests done, validity left and why, trend of each channel.\n\n"
        "Documents are kept in `logbook/results`; the file beside them is only an index."
    ),
)

Folder = Annotated[Path, typer.Option("--logbook", metavar="DIR", help="Folder of the logbook.")]
Documents = Annotated[
    list[Path],
    typer.Argument(metavar="RESULT", help="result.json of a graded test, or the folder of its run."),
]
DEFAULT = Path("logbook")


@app.command("add")
def add(documents: Documents, *, logbook: Folder = DEFAULT) -> None:
    """Put graded tests into the logbook; those that it has already are left alone."""
    from certkit.bench.legform_logbook import add_tests  # noqa: PLC0415  # waits until it is needed

    new, known = add_tests(documents, logbook)
    for entry in new:
        typer.echo(f"{entry.day} {entry.serial} {entry.procedure} {entry.verdict} {entry.id}")
    if known:
        typer.echo(f"{len(known)} already in the logbook", err=True)
    typer.echo(f"look at it: certkit history show --logbook {logbook}", err=True)


@app.command("show")
def show(
    serial: Annotated[
        list[str] | None, typer.Argument(metavar="SERIAL", help="Legforms; all when none is named.")
    ] = None,
    *,
    logbook: Folder = DEFAULT,
    rules: Annotated[
        Path | None,
        typer.Option(
            "--rules", metavar="RULES", help="Own rules' file, or shipped ones: r127 (if none), euro-ncap-v7."
        ),
    ] = None,
    on: Annotated[
        str | None,
        typer.Option(
            "--on", metavar="DAY", help="Day of interest: 2026-03-31 or today; else that of the last test."
        ),
    ] = None,
    html: Annotated[
        Path | None, typer.Option("--html", metavar="FILE", help="Write the page with pictures.")
    ] = None,
    language: options.Language = "en",
    force: options.Force = False,
    as_json: options.AsJson = False,
) -> None:
    """Show what is known of a legform: text, JSON or a page. Exit code 1 when a certification is due."""
    from certkit.bench.legform_logbook import logbook as overviews  # noqa: PLC0415  # waits
    from certkit.bench.result_folder import write_alone  # noqa: PLC0415  # likewise
    from certkit.cli.console import check_language  # noqa: PLC0415  # likewise
    from certkit.documents.output_document import listed_json  # noqa: PLC0415  # likewise
    from certkit.reporting.logbook_page import logbook_page  # noqa: PLC0415  # likewise
    from certkit.reporting.logbook_text import overview_text  # noqa: PLC0415  # likewise

    check_language(language)
    legs = overviews(logbook, serials=serial or (), rules=rules, day=on, curves=html is not None)
    if html:
        write_alone(html, logbook_page(legs, language), force=force)
        typer.echo(f"wrote {html}", err=True)
    if as_json:
        typer.echo(listed_json(legs), nl=False)
    else:
        typer.echo("\n\n\n".join(overview_text(leg) for leg in legs))
    raise typer.Exit(0 if all(leg.state == "valid" for leg in legs) else 1)


@app.command("rebuild")
def rebuild(*, logbook: Folder = DEFAULT) -> None:
    """Make the index again from the documents in the logbook's folder; it also mends itself."""
    from certkit.bench.legform_logbook import rebuild_index  # noqa: PLC0415  # waits until it is needed

    typer.echo(f"{rebuild_index(logbook)} tests", err=True)
