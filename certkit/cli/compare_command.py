"""`certkit compare`: two results or recordings beside each other."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import options  # typer reads the annotations

if TYPE_CHECKING:
    from certkit.documents.result import Verdict

Tested = Annotated[
    Path,
    typer.Argument(metavar="A", help="The reference: result.json, folder of a run, ISO-MME or CSV."),
]
Compared = Annotated[
    list[Path],
    typer.Argument(metavar="B", help="What is compared with it; several are compared one by one."),
]
Rule = Annotated[
    str | None,
    typer.Option("--rule", metavar="NAME|FILE", help="What the comparison has to keep; sets the exit code."),
]
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
    rule: Rule = None,
    out: CompareOut = None,
    formats: Annotated[
        str,
        typer.Option("--format", help=options.reports_help("certkit-comparison/1")),
    ] = "html",
    language: options.Language = "en",
    force: options.Force = False,
    library: options.Libraries = None,
    unverified: options.Unverified = False,
    as_json: options.AsJson = False,
) -> None:
    """Compare tests: error table, ISO/TS 18571 rating per channel, overlaid curves.

    Errors are (B − A) / A. When only one of two was measured, it is the reference, wherever it stands: many
    simulations against one test, or several tests against one simulation. With `--rule` the exit code is 0
    where every comparison keeps it, 1 where one does not, and 3 where one cannot be held against it.
    """
    from certkit.bench.compare import compare as put_beside  # noqa: PLC0415  # numpy waits until it is needed
    from certkit.bench.render_documents import render, reports_of  # noqa: PLC0415  # likewise
    from certkit.bench.result_folder import distinct_names  # noqa: PLC0415  # likewise
    from certkit.cli.console import check_language, tell  # noqa: PLC0415  # likewise
    from certkit.documents.comparison import ComparisonDocument  # noqa: PLC0415  # likewise
    from certkit.reporting.comparison_text import comparison_text, overview_text  # noqa: PLC0415  # likewise

    wanted = reports_of(ComparisonDocument, formats)
    check_language(language)
    several = len(b) > 1
    names = distinct_names([(path.stem, path.absolute().parent.name) for path in b])
    documents = []
    for path, name in zip(b, names, strict=True):
        document = put_beside(
            a,
            path,
            procedure=procedure,
            mapping=mapping,
            lenient=lenient,
            library=tuple(library or ()),
            until=None if until is None else until * 1e-3,
            unverified=unverified,
            rule=rule,
        )
        documents.append(document)
        usual = f"compare-{document.reference.label}-{document.other.label}".replace(" ", "-")
        folder = out or Path("runs") / usual
        written = render(
            document,
            folder / name if several and out is not None else folder,
            wanted,
            language=language,
            force=force,
            numbered=out is None,
            tell=tell,
        )
        folder = written[0].parent
        if not as_json:
            typer.echo(comparison_text(document))
        page = folder / "comparison.html"
        typer.echo(f"look at {page}" if page.exists() else f"written to {folder}", err=True)
    if as_json:
        listed = [document.to_json() for document in documents]
        typer.echo(f"[{', '.join(listed)}]" if several else listed[0], nl=several)
    elif several:
        typer.echo(overview_text(documents))
    raise typer.Exit(_code([document.verdict for document in documents]))


def _code(verdicts: list[Verdict | None]) -> int:
    """Return 3 where something could not be held against the rule, 1 where it is not kept, else 0."""
    if any(verdict not in {None, "pass", "fail"} for verdict in verdicts):
        return 3
    return 1 if "fail" in verdicts else 0
