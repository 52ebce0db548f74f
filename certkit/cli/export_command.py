"""`certkit export`: write a recording as ISO-MME or CSV."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # typer reads the annotations

Source = Annotated[
    Path, typer.Argument(metavar="SOURCE", help="result.json, the folder of a run, or measured data.")
]
Target = Annotated[
    Path,
    typer.Argument(metavar="TARGET", help="A new folder or a .zip: ISO-MME; a .csv: channels as a table."),
]
MappingFile = Annotated[
    Path | None, typer.Option("--mapping", metavar="MAP.yaml", help="Own ISO-MME channel codes.")
]


def export(
    source: Source,
    target: Target,
    *,
    mapping: MappingFile = None,
    force: options.Force = False,
    library: options.Libraries = None,
    unverified: options.Unverified = False,
) -> None:
    """Write the channels of a run or a test as ISO-MME (ISO/TS 13499) or CSV.

    `certkit export runs/pendulum pendulum.zip` writes an archive that `certkit grade` and other tools read.
    """
    from certkit.bench.export import export as write  # noqa: PLC0415  # numpy waits until it is needed

    write(
        source,
        target,
        mapping=mapping,
        force=force,
        library=tuple(library or ()),
        unverified=unverified,
    )
    typer.echo(f"wrote {target}; `certkit grade --procedure NAME {target}` grades it again", err=True)
