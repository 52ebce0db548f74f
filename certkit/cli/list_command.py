"""`certkit list`: what there is."""

from __future__ import annotations

from typing import Annotated

import typer

from certkit.cli import columns as table
from certkit.cli import completion, options


def list_(
    kind: Annotated[
        str | None,
        typer.Argument(
            metavar="[KIND]",
            help="procedure, corridors, legform, vehicle, reference, …",
            autocompletion=completion.kinds,
        ),
    ] = None,
    *,
    library: options.Libraries = None,
    as_json: options.AsJson = False,
) -> None:
    """List the procedures, corridors, legforms, vehicles and references that can be named.

    Own definitions in `--library` folders come first and replace shipped ones of the same name.
    """
    from certkit.definitions.loading.catalogue import catalogue  # noqa: PLC0415  # pydantic waits until it is needed

    entries = catalogue(kind, tuple(library or ()))
    if as_json:
        import json  # noqa: PLC0415  # only here

        rows = [{"kind": e.kind, "name": e.name, "title": e.title, "path": e.path} for e in entries]
        typer.echo(json.dumps(rows, indent=2, ensure_ascii=False))
        return
    table.show(("kind", "name", "title", "file"), [(e.kind, e.name, e.title, e.path) for e in entries])
