"""`certkit compare`: two results or recordings beside each other."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations

Tested = Annotated[
    Path,
    typer.Argument(metavar="A", help="The reference: result.json, folder of a run, ISO-MME or CSV."),
]
Compared = Annotated[Path, typer.Argument(metavar="B", help="What is compared with it.")]
Procedure = Annotated[
    str | None,
    typer.Option(
        "--procedure", "-p", metavar="NAME|FILE", help="By which measured data are conditioned beforehand."
    ),
]
MappingFile = Annotated[
    Path | None, typer.Option("--mapping", metavar="MAP.yaml", help="Mapping file for measured data.")
]
CompareOut = Annotated[
    Path | None, typer.Option("--out", help="Folder for the results.", show_default="runs/compare-A-B")
]
Until = Annotated[
    float | None, typer.Option("--until", metavar="MS", help="End of the comparison, ms after first contact.")
]


def compare(
    a: Tested,
    b: Compared,
    *,
    procedure: Procedure = None,
    mapping: MappingFile = None,
    lenient: Annotated[bool, typer.Option("--lenient", help="List assumptions instead of refusing.")] = False,
    until: Until = None,
    out: CompareOut = None,
    formats: Annotated[
        str, typer.Option("--format", help="`html`, `xlsx`, `pptx`, or `none`. The JSON is always written.")
    ] = "html",
    force: options.Force = False,
    library: options.Libraries = None,
    unverified: options.Unverified = False,
    as_json: options.AsJson = False,
) -> None:
    """Compare two tests: error table, ISO/TS 18571 rating per channel, overlaid curves.

    Errors are (B − A) / A. When only one of the two was measured, it is the reference, wherever it stands.
    """
    from certkit.bench.compare import compare as put_beside  # noqa: PLC0415  # numpy waits until it is needed
    from certkit.bench.render_documents import render, reports_of  # noqa: PLC0415  # likewise
    from certkit.documents.comparison import ComparisonDocument  # noqa: PLC0415  # likewise
    from certkit.reporting.comparison_report import comparison_text  # noqa: PLC0415  # likewise

    wanted = reports_of(ComparisonDocument, formats)
    document = put_beside(
        a,
        b,
        procedure=procedure,
        mapping=mapping,
        lenient=lenient,
        library=tuple(library or ()),
        until=None if until is None else until * 1e-3,
        unverified=unverified,
    )
    folder = out or Path("runs") / f"compare-{document.reference.label}-{document.other.label}".replace(
        " ", "-"
    )
    written = render(
        document,
        folder,
        wanted,
        force=force,
        numbered=out is None,
        tell=lambda what: typer.echo(what, err=True),
    )
    folder = written[0].parent
    typer.echo(document.to_json() if as_json else comparison_text(document), nl=not as_json)
    page = folder / "comparison.html"
    typer.echo(f"look at {page}" if page.exists() else f"written to {folder}", err=True)
