"""`certkit figure`: one figure of a result, for slides and papers."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations
from certkit.reporting.figure_list import help_text

Document = Annotated[Path, typer.Argument(metavar="RESULT.json", help="Result document.")]


def figure(
    result: Document,
    *,
    what: Annotated[
        str,
        typer.Option(
            "--what",
            help=help_text(),
        ),
    ] = "corridor",
    formats: Annotated[str, typer.Option("--format", help="svg, png, or both with a comma.")] = "svg",
    channel: Annotated[
        list[str] | None,
        typer.Option("--channel", help="Only this channel, criterion or load path. Repeatable."),
    ] = None,
    beside: Annotated[
        Path | None,
        typer.Option("--beside", metavar="RESULT.json", help="Second result, for history and frames."),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            metavar="FILE",
            help="Each format adds its ending.",
            show_default="PROCEDURE-WHAT beside the JSON",
        ),
    ] = None,
    unverified: options.Unverified = False,
    force: options.Force = False,
) -> None:
    """Draw one figure.

    `certkit figure runs/pendulum/result.json --what history --channel T1 --format svg,png`
    """
    from certkit.bench.result_folder import write_alone  # noqa: PLC0415  # nothing of this is needed for `--help`
    from certkit.reporting.figure_files import figure_files  # noqa: PLC0415  # likewise

    wanted = [name.strip() for name in formats.split(",") if name.strip()]
    name, contents = figure_files(
        result, what, wanted, channels=channel or (), beside=beside, unverified=unverified
    )
    base = out or result.parent / f"{name}-{what}"
    if base.suffix.removeprefix(".") in wanted:
        base = base.with_suffix("")
    for form, content in contents.items():
        path = base.with_name(f"{base.name}.{form}")
        write_alone(path, content, force=force)
        typer.echo(f"wrote {path}", err=True)
