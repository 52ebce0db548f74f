"""`certkit certify`: the certificate of one legform."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # typer reads the annotations

Serial = Annotated[str, typer.Argument(metavar="SERIAL", help="Serial number of the legform.")]
Tests = Annotated[
    list[Path] | None,
    typer.Argument(
        metavar="[RESULT]…",
        help="result.json of graded tests, or folders of their runs: put into the logbook first.",
        show_default=False,
    ),
]


def certify(
    serial: Serial,
    tests: Tests = None,
    *,
    logbook: Annotated[Path, typer.Option("--logbook", metavar="DIR", help="Folder of the logbook.")] = Path(
        "logbook"
    ),
    rules: Annotated[
        Path | None,
        typer.Option(
            "--rules",
            metavar="RULES",
            help="Own rules' file, or shipped ones: r127 (if none), euro-ncap-v7. They say what counts.",
        ),
    ] = None,
    on: Annotated[
        str | None,
        typer.Option(
            "--on", metavar="DAY", help="Day of issue: 2026-03-31 or today; else that of the last test."
        ),
    ] = None,
    lab: Annotated[
        Path | None,
        typer.Option(
            "--lab", metavar="LAB.yaml", help="Laboratory that issues it; else the one of the last test."
        ),
    ] = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="Folder.", show_default="runs/certificate-SERIAL")
    ] = None,
    formats: Annotated[
        str, typer.Option("--format", help=options.reports_help("certkit-certificate/1"))
    ] = "html,pdf",
    language: options.Language = "en",
    sign: options.Sign = None,
    force: options.Force = False,
    allow: options.Allow = None,
    as_json: options.AsJson = False,
) -> None:
    """Put the last certification tests of a legform into one certificate.

    `certkit certify FLX-0007` takes them from the logbook: the last test of each procedure that the rules ask
    for. A missing one is named, and the certificate is `not evaluated` then. Tests of another legform,
    simulated tests and replaced reports are refused. The exit code is the verdict's.
    """
    from certkit.bench.certify import certify as put_together  # noqa: PLC0415  # waits until it is needed
    from certkit.bench.render_documents import check_key, render  # noqa: PLC0415  # likewise
    from certkit.cli import console as terminal  # noqa: PLC0415  # likewise
    from certkit.documents.verdicts import EXIT_CODES  # noqa: PLC0415  # likewise
    from certkit.reporting.legform_certificate_report import certificate_text  # noqa: PLC0415  # likewise

    permitted = terminal.allowed(allow)
    terminal.check_language(language)
    check_key(sign)
    made = put_together(serial, tests or (), folder=logbook, rules=rules, day=on, laboratory=lab)
    folder = out or Path("runs") / f"certificate-{re.sub(r'[^A-Za-z0-9.-]+', '-', serial).strip('-.') or 'x'}"
    written = render(
        made,
        folder,
        formats,
        language=language,
        sign=sign,
        force=force,
        numbered=out is None,
        tell=terminal.tell,
    )
    typer.echo(made.to_json() if as_json else certificate_text(made), nl=not as_json)
    if not as_json:
        terminal.tell_files(written)
    raise typer.Exit(0 if made.verdict in permitted else EXIT_CODES[made.verdict])
