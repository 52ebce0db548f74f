"""`certkit extract`: vehicle stiffness curves from finite-element histories."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads annotations

if TYPE_CHECKING:
    from certkit.identification import ExtractionResult

DEFAULT_FORMATS = "html,pdf"


def extract(
    case: Annotated[
        Path, typer.Argument(metavar="CASE.yaml", help="The case: files, groups and load paths.")
    ],
    *,
    data: Annotated[
        Path | None, typer.Option("--data", metavar="DIR", help="Take the histories from here, same layout.")
    ] = None,
    name: Annotated[str | None, typer.Option("--name", help="Call the vehicle this.")] = None,
    out: options.Out = None,
    formats: options.Formats = DEFAULT_FORMATS,
    overrides: options.Overrides = None,
    as_json: options.AsJson = False,
    quiet: options.Quiet = False,
) -> None:
    """Extract a lumped vehicle from finite-element histories, by momentum and impulse.

    Writes the vehicle document, the extraction result and a report with the force, shortening and stiffness
    of every load path. Use the vehicle with `certkit run --procedure vehicle --set
    vehicle=FOLDER/vehicle.yaml`.
    """
    from certkit.bench.extract_vehicle import extract as extract_vehicle  # noqa: PLC0415  # numpy waits
    from certkit.bench.render_documents import render, reports_of  # noqa: PLC0415  # likewise
    from certkit.definitions.loading.overrides import overrides_from  # noqa: PLC0415  # likewise
    from certkit.documents.extraction import ExtractionResult  # noqa: PLC0415  # likewise

    wanted = reports_of(ExtractionResult, formats)
    result = extract_vehicle(
        case,
        data=data,
        name=name,
        overrides=overrides_from(overrides or ()),
        tell=(lambda _: None) if quiet or as_json else (lambda what: typer.echo(what, err=True)),
    )
    target = out or Path("runs") / result.case
    render(result, target, wanted)
    if as_json:
        typer.echo(result.to_json(), nl=False)
    else:
        _show(result, target)
    for warning in result.warnings:
        typer.echo(f"warning: {warning}", err=True)


def _show(result: ExtractionResult, target: Path) -> None:
    """Print one line a load path."""
    head = ("path", "peak force", "impulse", "closure", "law misfit", "known by")
    rows = [
        (
            path.name,
            f"{path.peak_force:.0f} N",
            f"{max(path.impulse, key=abs):.2f} N·s",
            f"{max(c.percent for c in path.closures):.2f} %" if path.closures else "–",
            f"{path.law.misfit_percent:.1f} %" if path.law else "–",
            path.known_by,
        )
        for path in result.paths
    ]
    widths = [max(len(row[k]) for row in (head, *rows)) for k in range(len(head))]
    for row in (head, *rows):
        typer.echo("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip())
    if result.material and result.material.rms_percent is not None:
        material = result.material
        typer.echo(
            f"stress–strain of {material.path} from strain {material.strain_from:g}: "
            f"{material.rms_percent:.1f} % rms, "
            f"{material.mean_percent:+.1f} % in the mean against the material's curve"
        )
    typer.echo(f"look at {target / 'extraction.html'}", err=True)
    if result.vehicle:
        typer.echo(f"use it: certkit run vehicle --set vehicle={target / 'vehicle.yaml'}", err=True)
