"""`certkit twin`: which part of a leg explains how its recordings differ."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # typer reads the annotations

Recordings = Annotated[
    list[Path],
    typer.Argument(
        metavar="TEST", help="Graded test of one legform: report.pdf, result.json or the folder of its run."
    ),
]


def twin(
    recordings: Recordings,
    *,
    diagnosis: Annotated[
        str, typer.Option("--diagnosis", metavar="NAME|FILE", help="The parts that are looked at.")
    ] = "flex-pli-gtr",
    against: Annotated[
        Path | None,
        typer.Option(
            "--against", metavar="TEST", help="Earlier test of the leg: look for what changed since."
        ),
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder for the results.", show_default="runs/twin")
    ] = None,
    formats: Annotated[str, typer.Option("--format", help=options.reports_help("certkit-twin/1"))] = "html",
    force: options.Force = False,
    library: options.Libraries = None,
    as_json: options.AsJson = False,
) -> None:
    """Fit the model to a leg's recordings, one part at a time, and say which part explains how it differs.

    Whole curves count, with the noise, gains and time zero that recordings have. Each part comes with its
    change, a 95 % interval and a remedy; parts that cannot be told apart are all named.
    """
    from certkit.bench.render_documents import reports_of  # noqa: PLC0415  # numpy waits
    from certkit.cli.console import render_and_tell  # noqa: PLC0415  # likewise
    from certkit.documents.twin_report import TwinReport  # noqa: PLC0415  # likewise
    from certkit.reporting.twin_page import twin_text  # noqa: PLC0415  # likewise
    from certkit.studies.leg_twin import twin as tell_parts  # noqa: PLC0415  # likewise

    wanted = reports_of(TwinReport, formats)
    document = tell_parts(recordings, diagnosis=diagnosis, against=against, library=library or ())
    render_and_tell(document, twin_text(document), out, "twin", wanted, force=force, as_json=as_json)
