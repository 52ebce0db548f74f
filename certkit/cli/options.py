"""Options that several commands share, with one wording."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import completion
from certkit.reporting.document_reports import REPORTS
from certkit.reporting.language_list import languages

Out = Annotated[Path | None, typer.Option("--out", help="Folder for the results.", show_default="runs/NAME")]


def reports_help(schema: str) -> str:
    """Return the help of `--format` for a kind of document, by its schema: the formats that there are."""
    known = ", ".join(REPORTS[schema].formats)
    return f"Reports to write, separated by commas: {known}; or none. The JSON is always written."


Formats = Annotated[str, typer.Option("--format", help=reports_help("certkit-result/1"))]
Overrides = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="PATH=VALUE",
        help="Change a value for this run, e.g. 'rig.ram.speed=11.3 m/s' or 'legform=my-leg'. Repeatable.",
        autocompletion=completion.settings,
    ),
]
Libraries = Annotated[
    list[Path] | None,
    typer.Option("--library", metavar="DIR", help="Folder with own definitions; searched first. Repeatable."),
]
Language = Annotated[
    str,
    typer.Option("--language", metavar="CODE", help=f"Language of pages and PDFs: {', '.join(languages())}."),
]
Force = Annotated[
    bool, typer.Option("--force", help="Overwrite another result that stands where this one goes.")
]
Sign = Annotated[
    Path | None,
    typer.Option(
        "--sign",
        metavar="KEY.p12",
        help="Sign the PDFs with this PKCS #12 key; its passphrase comes from CERTKIT_PASSPHRASE.",
    ),
]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Only the verdict table and errors.")]
Verbose = Annotated[bool, typer.Option("--verbose", "-v", help="Also tell what is done, step by step.")]
Details = Annotated[
    bool, typer.Option("--details", help="Of several results, also show the criteria of each.")
]
Unverified = Annotated[
    bool,
    typer.Option(
        "--unverified",
        help="Take a document that was changed since certkit wrote it, and say so on everything made of it.",
    ),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print the JSON document alone on standard output.")]
Allow = Annotated[
    list[str] | None,
    typer.Option(
        "--allow",
        metavar="VERDICT",
        help="`not-evaluated`: exit with 0 instead of 4 when nothing worse happened.",
    ),
]

DEFAULT_FORMATS = "html,pdf,junit,csv"
