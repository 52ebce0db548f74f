"""`certkit verify`: say whether a certificate still holds."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations

Certificate = Annotated[
    list[Path],
    typer.Argument(
        metavar="CERTIFICATE", help="A document (result.json, …), report.pdf, or a run's folder. Repeatable."
    ),
]


def verify(
    certificate: Certificate,
    *,
    as_json: options.AsJson = False,
    verbose: options.Verbose = False,
) -> None:
    """Check every hash of a certificate, grade it again from what it carries, and say whether it still holds.

    Exit code 0 when it holds, 1 when it does not, 2 when it cannot be read.
    """
    import json  # noqa: PLC0415  # waits until a certificate is verified
    from dataclasses import asdict  # noqa: PLC0415  # likewise

    from certkit.bench.verify import verify as check  # noqa: PLC0415  # likewise

    found = [check(path) for path in certificate]
    if as_json:
        typer.echo(
            json.dumps(
                [{**asdict(each), "holds": each.holds} for each in found], ensure_ascii=False, indent=1
            )
        )
    for each in () if as_json else found:
        for one in each.checks:
            if verbose or not one.holds:
                typer.echo(f"{'✓' if one.holds else '✗'} {one.what}{': ' if one.said else ''}{one.said}")
        count = len(each.checks)
        said = f"holds: {count} checks" if each.holds else "does not hold"
        typer.echo(f"{each.certificate} ({', '.join(each.ids)}) {said}")
    raise typer.Exit(0 if all(each.holds for each in found) else 1)
