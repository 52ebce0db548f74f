"""`certkit validate`: check definition files before anything runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from certkit.cli import options  # noqa: TC001  # likewise


def validate(
    files: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[FILE]…", help="YAML files of any kind.", show_default=False),
    ] = None,
    *,
    every: Annotated[bool, typer.Option("--all", help="Check everything that `certkit list` shows.")] = False,
    library: options.Libraries = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the problems as a JSON list.")] = False,
) -> None:
    """Check definitions: every problem at once, each with file, line and column, and what to do about it."""
    from certkit.definitions.loading.lint import survey, survey_all  # noqa: PLC0415  # pydantic waits until needed
    from certkit.errors import DefinitionError, UsageError  # noqa: PLC0415  # beside its neighbour

    if bool(files) == every:
        raise UsageError("name the files to check, or use --all")
    stores = tuple(library or ())
    checked = survey_all(stores) if every else [survey(path, stores) for path in files or ()]
    problems = [problem for _, found in checked for problem in found]
    if as_json:
        import json  # noqa: PLC0415  # only here

        typer.echo(json.dumps([problem._asdict() for problem in problems], indent=2, ensure_ascii=False))
        raise typer.Exit(DefinitionError.exit_code if problems else 0)
    for file, found in checked:
        if not found:
            typer.echo(f"{file}: ok{'' if every else _found_as(Path(file))}")
    if problems:
        raise DefinitionError(problems)


def _found_as(file: Path) -> str:
    """Say how a file would have to be called to be found by its name, where it is called otherwise."""
    from certkit.definitions.loading.lint import other_name  # noqa: PLC0415  # likewise

    said = other_name(file)
    return f"; to be found by its name, its file has to be called `{said}.yaml`" if said else ""
