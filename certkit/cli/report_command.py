"""`certkit report`: render again, from result documents alone."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

Documents = Annotated[
    list[Path],
    typer.Argument(metavar="RESULT.json...", help="Result documents; several are also bound into a suite."),
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
        str, typer.Option("--format", help="Separated by commas: html, pdf, junit, csv, md.")
    ] = "html,pdf",
    paper: Annotated[Paper, typer.Option("--paper", help="Page size of the PDF.")] = Paper.A4,
    sign: Annotated[
        Path | None,
        typer.Option(
            "--sign",
            metavar="KEY.p12",
            help="Sign the PDFs with this PKCS #12 key; its passphrase is taken from CERTKIT_PASSPHRASE.",
        ),
    ] = None,
    title: Annotated[str, typer.Option("--title", help="Title of a suite.")] = "Certification suite",
) -> None:
    """Render reports again from result.json: the same bytes as the run wrote."""
    from certkit.documents.result_json import read_result  # noqa: PLC0415  # likewise
    from certkit.files import write_whole  # noqa: PLC0415  # pydantic waits until it is needed
    from certkit.reporting import render, render_suite  # noqa: PLC0415  # likewise
    from certkit.reporting.signing import sign as sign_pdf  # noqa: PLC0415  # likewise

    wanted = [name.strip() for name in formats.split(",") if name.strip()]
    documents = [read_result(path) for path in results]
    written: list[Path] = []
    for path, document in zip(results, documents, strict=True):
        folder = path.parent if out is None else out / document.procedure if len(results) > 1 else out
        written += render(document, folder, wanted, paper=paper.value)
    if len(documents) > 1:
        folder = results[0].parent.parent if out is None else out
        written += render_suite(documents, folder, wanted, title=title, paper=paper.value)
    if sign is not None:
        for path in written:
            if path.suffix == ".pdf":
                write_whole(path, sign_pdf(path.read_bytes(), sign))
    for path in written:
        typer.echo(f"wrote {path}", err=True)
