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
            autocompletion=completion.kinds_and_documents,
            help="procedure, corridors, legform, …; or what certkit writes: result, comparison, …",
        ),
    ],
) -> None:
    """Print the JSON Schema of a kind of definition, or of a document that certkit writes.

    An editor with a YAML language server completes and checks a file that begins with
    `# yaml-language-server: $schema=procedure.schema.json`.
    """
    from certkit.definitions.loading.json_schema import DIALECT, schema_of  # noqa: PLC0415  # likewise
    from certkit.definitions.loading.kinds import kind_of  # noqa: PLC0415  # pydantic waits until it is needed
    from certkit.documents.document_kinds import DOCUMENTS, document_class  # noqa: PLC0415  # likewise

    if kind in DOCUMENTS:
        described = {"$schema": DIALECT, **document_class(kind).model_json_schema(by_alias=True)}
    else:
        described = schema_of(kind_of(kind))
    typer.echo(json.dumps(described, indent=2, ensure_ascii=False))
