"""`certkit extract`: vehicle stiffness curves from finite-element histories."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads annotations
from certkit.errors import UsageError

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
    from certkit.definitions.loading.library import load  # noqa: PLC0415  # pydantic waits until a case is read
    from certkit.exchange.fe import data_folder  # noqa: PLC0415  # likewise
    from certkit.files import write_whole  # noqa: PLC0415  # likewise
    from certkit.identification import vehicle_text  # noqa: PLC0415  # likewise
    from certkit.identification.five_steps import extract as run  # noqa: PLC0415  # numpy waits
    from certkit.reporting import render_extraction  # noqa: PLC0415  # likewise

    wanted = {name.strip() for name in formats.split(",") if name.strip()}
    if wanted - {"html", "pdf"}:
        unknown = min(wanted - {"html", "pdf"})
        raise UsageError(f"there is no extraction report in `{unknown}`; write html, pdf or both")
    changes = [*(overrides or ()), *([f"vehicle={name}"] if name else ())]
    loaded = load("case", case, overrides=changes)
    document = loaded.document
    folder = data or data_folder(document.histories, case.parent)
    tell = (lambda _: None) if quiet or as_json else (lambda what: typer.echo(what, err=True))
    result = run(
        document, folder, case_folder=case.parent, case_digest={case.name: loaded.sha256}, progress=tell
    )
    vehicle = vehicle_text(result) if result.vehicle else None
    target = out or Path("runs") / result.case
    write_whole(target / "extraction.json", result.to_json())
    if vehicle is not None:
        write_whole(target / "vehicle.yaml", vehicle)
    render_extraction(result, target, wanted)
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
    typer.echo(f"written to {target}")
