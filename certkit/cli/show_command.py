"""`certkit show`: one definition, readable, with the origin and confidence of each number."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from certkit.cli import columns as table
from certkit.cli import completion, options

if TYPE_CHECKING:
    from certkit.definitions.loading.summary import Sheet


def show(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME|FILE",
            help="As in `certkit list`, or a YAML file.",
            autocompletion=completion.definitions,
        ),
    ],
    *,
    kind: Annotated[
        str | None, typer.Option("--kind", help="Where several kinds have the name: legform, fit, …")
    ] = None,
    overrides: options.Overrides = None,
    library: options.Libraries = None,
    as_file: Annotated[
        bool, typer.Option("--file", help="Print the file as it is, to begin an own one from it.")
    ] = False,
    as_json: options.AsJson = False,
) -> None:
    """Show a definition: what it is, what it measures, and where each number comes from."""
    from certkit.definitions.loading.overrides import overrides_from  # noqa: PLC0415  # likewise
    from certkit.definitions.loading.summary import sheet  # noqa: PLC0415  # pydantic waits until it is needed

    shown = sheet(name, kind, library=tuple(library or ()), overrides=overrides_from(overrides or ()))
    if as_file:
        from certkit.definitions.loading.kinds import kind_of  # noqa: PLC0415  # only here
        from certkit.definitions.loading.library import find  # noqa: PLC0415  # likewise

        typer.echo(find(kind_of(shown.kind), name, tuple(library or ())).data.decode(), nl=False)
        return
    if as_json:
        import json  # noqa: PLC0415  # only here

        typer.echo(json.dumps(shown.as_data(), indent=2, ensure_ascii=False))
        return
    _print(shown)


def _print(shown: Sheet) -> None:
    typer.secho(f"{shown.noun} {shown.name}", bold=True)
    for line in shown.head:
        typer.echo(line)
    if shown.criteria:
        typer.echo()
        heads = ("criterion", "what is measured", "has to be", "confidence", "source")
        table.show(heads, shown.criteria, title="Criteria")
    if shown.numbers:
        typer.echo()
        rows = [(n.path, n.value, n.confidence, n.source) for n in shown.numbers]
        table.show(("number", "value", "confidence", "source"), rows, title="Numbers")
    if shown.awaited:
        typer.echo()
        table.show(("corridor", "why it is not here"), shown.awaited, title="Awaited")
    for note in shown.notes:
        typer.echo(f"note: {note}")
