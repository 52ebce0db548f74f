"""`certkit schema`: JSON Schemas for editors and for whoever reads results."""

from __future__ import annotations

import json
from typing import Annotated

import typer

from certkit.cli import completion


def schema(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="KIND",
            autocompletion=completion.kinds_and_result,
            help="procedure, corridors, legform, vehicle, reference, …; or result, for result.json.",
        ),
    ],
) -> None:
    """Print the JSON Schema of a kind of definition, or of the result document.

    An editor with a YAML language server completes and checks a file that begins with
    `# yaml-language-server: $schema=procedure.schema.json`.
    """
    from certkit.definitions.loading.json_schema import DIALECT, schema_of  # noqa: PLC0415  # likewise
    from certkit.definitions.loading.kinds import kind_of  # noqa: PLC0415  # pydantic waits until it is needed

    if kind == "result":
        from certkit.documents.result import Result  # noqa: PLC0415  # likewise

        described = {"$schema": DIALECT, **Result.model_json_schema(by_alias=True)}
    else:
        described = schema_of(kind_of(kind))
    typer.echo(json.dumps(described, indent=2, ensure_ascii=False))
