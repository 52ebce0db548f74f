"""`python -m docs.make`: make the generated pages and pictures of the documentation again."""

from __future__ import annotations

from typing import Annotated

import typer

app = typer.Typer(no_args_is_help=True, help="Make the generated parts of the documentation again.")


@app.callback()
def _parts() -> None:
    """Let each part be made by its own word."""


@app.command("reference")
def reference() -> None:
    """Write commands.md, definitions.md and result.md from the code."""
    from docs.make.reference import write_reference  # noqa: PLC0415  # each command pays for its own imports

    for path in write_reference():
        typer.echo(f"wrote {path}")


@app.command("pictures")
def pictures() -> None:
    """Run the bench and draw all pictures of docs/pictures; takes some minutes and needs Chromium."""
    from docs.make.pictures import write_pictures  # noqa: PLC0415  # as above

    for path in write_pictures(tell=typer.echo):
        typer.echo(f"wrote {path} ({path.stat().st_size / 1000:.0f} kB)")


@app.command("validation")
def validation() -> None:
    """Run what docs/validation.md rests on, and write it; takes some minutes."""
    from certkit.files import write_whole  # noqa: PLC0415  # as above
    from docs.make.reference import DOCS  # noqa: PLC0415  # as above
    from docs.make.validation import validation as make  # noqa: PLC0415  # as above

    write_whole(DOCS / "validation.md", make(typer.echo))
    typer.echo(f"wrote {DOCS / 'validation.md'}")


@app.command("security")
def security(
    part: Annotated[list[str] | None, typer.Option(help="Only this part; repeatable.")] = None,
    kills: Annotated[int, typer.Option(help="How often each kind of command is killed.")] = 10,
    python: Annotated[list[str] | None, typer.Option(help="A further interpreter; repeatable.")] = None,
) -> None:
    """Try forgeries, bombs, kills, writers, environments; write what came of each into docs/security.md."""
    from docs.make.security import PARTS, write_security  # noqa: PLC0415  # as above

    path = write_security(typer.echo, part or PARTS, kills=kills, pythons=python or ())
    typer.echo(f"wrote {path}")


@app.command("reliability")
def reliability(seed: int | None = None, every: int = 4) -> None:
    """Try damaged inputs and write docs/reliability.md; takes some minutes, `--every 1` half an hour."""
    from certkit.files import write_whole  # noqa: PLC0415  # as above
    from docs.make.reference import DOCS  # noqa: PLC0415  # as above
    from docs.make.reliability import reliability as make  # noqa: PLC0415  # as above

    write_whole(DOCS / "reliability.md", make(seed, every, typer.echo))
    typer.echo(f"wrote {DOCS / 'reliability.md'}")


app()
