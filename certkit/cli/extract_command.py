"""`certkit extract`: vehicle stiffness curves from finite-element histories."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import options  # typer reads annotations

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult

DEFAULT_FORMATS = "html,pdf"
DEFAULT_PROCEDURE = "vehicle-fe-front"

NOT_CLOSED, NOT_TRUSTED = 1, 3
"""Exit codes: the impulse of some path does not close; a self-check misses its limit."""


def extract(
    case: Annotated[
        Path, typer.Argument(metavar="CASE.yaml", help="The case: files, groups and load paths.")
    ],
    *,
    data: Annotated[
        Path | None, typer.Option("--data", metavar="DIR", help="Take the histories from here, same layout.")
    ] = None,
    name: Annotated[str | None, typer.Option("--name", help="Call the vehicle this.")] = None,
    procedure: Annotated[
        str,
        typer.Option("--procedure", metavar="NAME|FILE", help="Which leg hits the front in the self-checks."),
    ] = DEFAULT_PROCEDURE,
    checks: Annotated[
        bool, typer.Option("--checks/--no-checks", help="Hold the front, the leg and both to the run.")
    ] = True,
    propose: Annotated[
        bool,
        typer.Option("--propose", help="Only print the case with a first grouping of its parts, to edit."),
    ] = False,
    unclosed: Annotated[
        bool, typer.Option("--unclosed", help="Write the vehicle though the impulse does not close.")
    ] = False,
    out: options.Out = None,
    formats: Annotated[
        str, typer.Option("--format", help=options.reports_help("certkit-extraction/1"))
    ] = DEFAULT_FORMATS,
    force: options.Force = False,
    overrides: options.Overrides = None,
    as_json: options.AsJson = False,
    quiet: options.Quiet = False,
) -> None:
    """Extract a lumped vehicle from finite-element histories, by momentum and impulse.

    Writes the vehicle document, the extraction result and a report with the force, shortening and stiffness
    of every load path. The front, the leg and their contact, each alone, and all together are then held to
    the run. Use the vehicle with `certkit run --procedure vehicle --set vehicle=FOLDER/vehicle.yaml`.

    Exit codes: 0 the impulse closes and the front moves as in its run; 1 the impulse of a path does not
    close (then no vehicle is written, unless with `--unclosed`); 2 wrong usage or data; 3 a self-check is
    off by more than the case's limit, so that the vehicle cannot be trusted. Where a path's impulse is known
    from one side only, a warning says so, and the self-checks decide; with `--no-checks` that counts as not
    closed.
    """
    from certkit.bench.extract_vehicle import extract as extract_vehicle  # noqa: PLC0415  # numpy waits
    from certkit.bench.render_documents import render, reports_of  # noqa: PLC0415  # likewise
    from certkit.cli.console import tell  # noqa: PLC0415  # likewise
    from certkit.definitions.loading.overrides import overrides_from  # noqa: PLC0415  # likewise
    from certkit.documents.extraction import ExtractionResult  # noqa: PLC0415  # likewise

    if propose:
        from certkit.bench.propose_case import proposed_case  # noqa: PLC0415  # likewise

        typer.echo(proposed_case(case, data=data, overrides=overrides_from(overrides or ())), nl=False)
        return
    wanted = reports_of(ExtractionResult, formats)
    result = extract_vehicle(
        case,
        data=data,
        name=name,
        overrides=overrides_from(overrides or ()),
        procedure=procedure if checks else None,
        tell=(lambda _: None) if quiet or as_json else tell,
    )
    closed = result.closed or (result.closed is None and bool(result.checks))
    if not closed and not unclosed:
        result = result.model_copy(update={"vehicle": None}).with_id()
    written = render(
        result,
        out or Path("runs") / result.case,
        wanted,
        force=force,
        numbered=out is None,
        tell=tell,
    )
    target = written[0].parent
    if as_json:
        typer.echo(result.to_json(), nl=False)
    else:
        _show(result)
        by_kind = {path.suffix: path for path in reversed(written)}
        typer.echo(f"look at {by_kind.get('.html') or by_kind.get('.pdf') or written[0]}", err=True)
        if result.vehicle:
            typer.echo(f"use it: certkit run vehicle --set vehicle={target / 'vehicle.yaml'}", err=True)
    for warning in result.warnings:
        typer.echo(f"warning: {warning}", err=True)
    if not closed:
        typer.echo("the impulse does not close on every path, see the warnings", err=True)
        raise typer.Exit(NOT_CLOSED)
    from certkit.reporting.extraction_text import check_sentence  # noqa: PLC0415  # not for `--help`

    missed = [check for check in result.checks if check.within is False]
    for check in missed:
        typer.echo(f"cannot be trusted: {check_sentence(check)}", err=True)
    if missed:
        raise typer.Exit(NOT_TRUSTED)


def _show(result: ExtractionResult) -> None:
    """Print one line a load path."""
    from certkit.reporting.extraction_text import paths_table  # noqa: PLC0415  # not for `--help`

    typer.echo(paths_table(result))
    if result.material and result.material.rms_percent is not None:
        from certkit.reporting.number_format import signed  # noqa: PLC0415  # likewise

        material = result.material
        typer.echo(
            f"stress–strain of {material.path} from strain {material.strain_from:g}: "
            f"{material.rms_percent:.1f} % rms, "
            f"{signed(material.mean_percent, 1)} % in the mean against the material's curve"
        )
    from certkit.reporting.extraction_findings import findings  # noqa: PLC0415  # not for `--help`
    from certkit.reporting.extraction_text import (  # noqa: PLC0415  # likewise
        channels_table,
        check_sentence,
        left_out,
    )
    from certkit.reporting.language import language  # noqa: PLC0415  # likewise

    table = channels_table(result)
    if table:
        typer.echo(f"\n{table}\n")
    for check in result.checks:
        typer.echo(check_sentence(check))
    missing = left_out(result)
    if missing:
        typer.echo(missing)
    for finding in findings(result, language().word):
        typer.echo(f"→ {finding}")
