"""`certkit report`: render again, from the documents alone."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations
from certkit.errors import RunError
from certkit.reporting.report_formats import FORMATS

Documents = Annotated[
    list[Path],
    typer.Argument(
        metavar="DOCUMENT.json...",
        help="What certkit wrote: result, comparison, … Several results are also bound into a suite.",
    ),
]


class Paper(StrEnum):
    """Page sizes of the PDF."""

    A4 = "A4"
    LETTER = "Letter"


def report(
    results: Documents,
    *,
    out: Annotated[Path | None, typer.Option("--out", help="Folder.", show_default="beside the JSON")] = None,
    formats: Annotated[
        str | None,
        typer.Option(
            "--format",
            help=f"Separated by commas: {', '.join(FORMATS)}.",
            show_default="html, and pdf where there is one",
        ),
    ] = None,
    language: options.Language = "en",
    paper: Annotated[Paper, typer.Option("--paper", help="Page size of the PDF.")] = Paper.A4,
    sign: options.Sign = None,
    template: Annotated[
        Path | None,
        typer.Option(
            "--template",
            metavar="FILE.pptx",
            help="Look of the slides: a presentation of your own. For all commands: CERTKIT_PPTX_TEMPLATE.",
        ),
    ] = None,
    unverified: options.Unverified = False,
    force: options.Force = False,
    title: Annotated[str, typer.Option("--title", help="Title of a suite.")] = "Certification suite",
) -> None:
    """Render any document that certkit wrote again, from its JSON alone: the same bytes as before."""
    from certkit.bench.render_documents import render_pages, render_suite  # noqa: PLC0415  # pydantic waits until now
    from certkit.bench.result_folder import distinct_names, folder_name  # noqa: PLC0415  # likewise
    from certkit.documents.document_kinds import document_at, read_documents  # noqa: PLC0415  # likewise
    from certkit.documents.result import Result  # noqa: PLC0415  # likewise
    from certkit.reporting.slide_deck import on_template  # noqa: PLC0415  # likewise

    wanted = None if formats is None else [name.strip() for name in formats.split(",") if name.strip()]
    results = [document_at(path) for path in results]
    documents = [
        (path, document) for path in results for document in read_documents(path, unverified=unverified)
    ]
    names = distinct_names([(folder_name(doc, path), path.absolute().parent.name) for path, doc in documents])
    # Pages of a list of overviews have names of their own; those of several results are all called alike.
    apart = len(results) > 1 or sum(isinstance(document, Result) for _, document in documents) > 1
    written: list[Path] = []
    folders: list[Path] = []
    with on_template(template):
        for (path, document), name in zip(documents, names, strict=True):
            folder = path.parent if out is None else out / name if apart else out
            written += render_pages(
                document, folder, wanted, paper=paper.value, language=language, sign=sign, force=force
            )
            folders += [folder] if isinstance(document, Result) else []
        tests = [document for _, document in documents if isinstance(document, Result)]
        if len(tests) > 1:
            written += render_suite(
                tests,
                results[0].parent.parent if out is None else out,
                wanted or ["html", "pdf"],
                title=title,
                paper=paper.value,
                language=language,
                sign=sign,
                force=force,
                folders=folders,
            )
    for path in written:
        typer.echo(f"wrote {path}", err=True)
    endings = {path.suffix.lstrip(".") for path in written}
    if any(each in (wanted or ()) and each not in endings for each in ("pdf", "xlsx", "pptx")):
        raise typer.Exit(RunError.exit_code)  # asked for by name, and a remark has said why it is missing
