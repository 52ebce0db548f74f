"""`certkit campaign`: a car judged by its impact points."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # typer reads the annotations

Car = Annotated[
    Path, typer.Argument(metavar="CAR.yaml", help="The campaign: car, schemes, points with their sources.")
]


def campaign(
    car: Car,
    *,
    out: options.Out = None,
    formats: Annotated[
        str,
        typer.Option("--format", help=options.reports_help("certkit-campaign/1")),
    ] = "html,csv,junit",
    language: options.Language = "en",
    force: options.Force = False,
    library: options.Libraries = None,
    allow: options.Allow = None,
    unverified: options.Unverified = False,
    as_json: options.AsJson = False,
    quiet: options.Quiet = False,
) -> None:
    """Judge a car by its impact points, each with its sources: measured, finite elements, lumped, predicted.

    Writes one page with the car's front, the table of points and the score of each scheme, and the report of
    every result behind it. The exit code is that of the worst scheme that gates: 0 pass, 1 fail or
    conditional, 4 not evaluated.
    """
    from certkit.bench.assess_campaign import assess  # noqa: PLC0415  # numpy waits until it is needed
    from certkit.bench.campaign_pages import write_campaign  # noqa: PLC0415  # likewise
    from certkit.bench.render_documents import reports_of  # noqa: PLC0415  # likewise
    from certkit.cli import console as terminal  # noqa: PLC0415  # likewise
    from certkit.documents.campaign_report import CampaignReport  # noqa: PLC0415  # likewise
    from certkit.documents.verdicts import EXIT_CODES  # noqa: PLC0415  # likewise
    from certkit.reporting.campaign_text import campaign_text  # noqa: PLC0415  # likewise

    wanted = reports_of(CampaignReport, formats)
    permitted = terminal.allowed(allow)
    terminal.check_language(language)
    with terminal.progress(0, quiet=quiet or as_json) as step:
        found = assess(car, library=tuple(library or ()), unverified=unverified, step=step)
    document = found.document
    written = write_campaign(
        document,
        found.results,
        out or Path("runs") / document.campaign,
        wanted,
        language=language,
        force=force,
        numbered=out is None,
        tell=terminal.tell,
    )
    folder = written[0].parent
    typer.echo(document.to_json() if as_json else campaign_text(document), nl=not as_json)
    page = folder / "campaign.html"
    typer.echo(f"look at {page}" if page.exists() else f"written to {folder}", err=True)
    raise typer.Exit(0 if document.verdict in permitted else EXIT_CODES[document.verdict])
