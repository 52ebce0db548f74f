"""The commands, one file each, and the panels of the help that list them.

A new command is a file NAME_command.py beside the others, with a function of its name, and one line here. A
group of commands has a typer `app` of its own instead.
"""

from __future__ import annotations

import inspect
import os
from importlib import import_module
from typing import TYPE_CHECKING, Annotated, Any

import typer

from certkit._version import __version__
from certkit.cli.value_words import WordedCommand, WordedGroup

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

TESTS = "Tests"
MODELS = "Models and studies"
DEFINITIONS = "Definitions"

PANELS = {
    "run": TESTS,
    "grade": TESTS,
    "compare": TESTS,
    "campaign": TESTS,
    "certify": TESTS,
    "report": TESTS,
    "figure": TESTS,
    "export": TESTS,
    "verify": TESTS,
    "roundrobin": TESTS,
    "extract": MODELS,
    "calibrate": MODELS,
    "study": MODELS,
    "twin": MODELS,
    "uncertainty": MODELS,
    "confirm": DEFINITIONS,
    "list": DEFINITIONS,
    "show": DEFINITIONS,
    "validate": DEFINITIONS,
    "schema": DEFINITIONS,
    "history": TESTS,
}
"""The panel of each command, in the order of the help: groups stand last in theirs."""


def app_for(words: Sequence[str]) -> typer.Typer:
    """Return the app with as much of its commands as the words of a command line ask for.

    Reading and building all of them costs 30 ms; the list of all needs none of their options.
    """
    first = words[0] if words else ""
    if first in {"-h", "--help"} or not (words or "_CERTKIT_COMPLETE" in os.environ):
        return _app(PANELS, listed=True)
    return _app([first] if first in PANELS else PANELS)


def whole_app() -> typer.Typer:
    """Return the app with all commands and their options."""
    return _app(PANELS)


def _app(names: Collection[str], *, listed: bool = False) -> typer.Typer:
    app = typer.Typer(
        name="certkit",
        cls=WordedGroup,
        no_args_is_help=True,
        rich_markup_mode="markdown",
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
        help=(
            "Certify a Flex-PLI legform: simulate its tests or grade measured ones, "
            "and hand over the certificate.\n\n"
            "Start with `certkit run pendulum`."
        ),
        epilog=(
            "Exit codes: 0 pass · 1 fail or conditional · 2 bad definition or usage · "
            "3 run or numerical error · 4 not evaluated."
        ),
    )
    app.callback()(_options)
    for name in names:
        add = _list if listed else _add
        add(app, name, import_module(f"certkit.cli.{name}_command"))
    return app


def _add(app: typer.Typer, name: str, file: Any) -> None:  # noqa: ANN401  # a module's attributes are of any type
    """Add a command, or a group of them, with its options."""
    group: typer.Typer | None = getattr(file, "app", None)
    if group is None:
        app.command(name, cls=WordedCommand, rich_help_panel=PANELS[name])(_function(name, file))
        return
    for info in group.registered_commands:
        info.cls = WordedCommand
    app.add_typer(group, name=name, cls=WordedGroup, rich_help_panel=PANELS[name])


def _list(app: typer.Typer, name: str, file: Any) -> None:  # noqa: ANN401  # as above
    """Add a command as the list of all of them shows it: without its options."""
    group: typer.Typer | None = getattr(file, "app", None)
    words = inspect.getdoc(_function(name, file)) if group is None else group.info.help
    app.command(name, help=words, rich_help_panel=PANELS[name])(lambda: None)


def _function(name: str, file: Any) -> Any:  # noqa: ANN401  # as above
    """Return what carries a command out: `list_` where its word means something else in Python."""
    return getattr(file, name, None) or getattr(file, f"{name}_")


def _version(*, wanted: bool) -> None:
    if wanted:
        typer.echo(f"certkit {__version__}")
        raise typer.Exit


def _options(
    *,
    version: Annotated[
        bool, typer.Option("--version", callback=lambda v: _version(wanted=v), is_eager=True, help="Show it.")
    ] = False,
) -> None:
    """Take the options that stand before a command."""
    del version
