"""The command line: one small file a command, no logic. Heavy imports wait until a command runs."""

from __future__ import annotations

import copy
import errno
import gc
import inspect
import os
import sys
import traceback
import warnings
from typing import TYPE_CHECKING, Annotated, TextIO

import typer
from typer.models import CommandInfo, TyperInfo

from certkit._version import __version__
from certkit.cli import (
    calibrate_command,
    campaign_command,
    certify_command,
    compare_command,
    confirm_command,
    export_command,
    extract_command,
    figure_command,
    grade_command,
    history_command,
    list_command,
    report_command,
    roundrobin_command,
    run_command,
    schema_command,
    show_command,
    study_command,
    twin_command,
    uncertainty_command,
    validate_command,
    verify_command,
)
from certkit.cli.completion import BASH, words_of_bash
from certkit.cli.output_streams import end_streams, guard_streams
from certkit.cli.value_words import WordedCommand, WordedGroup
from certkit.errors import CertkitError, LeftOutWarning, OldFormWarning, UsageError

if TYPE_CHECKING:
    from collections.abc import Sequence

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
        "Exit codes: 0 pass · 1 fail or conditional · 2 bad definition or usage · 3 run or numerical error · "
        "4 not evaluated."
    ),
)

TESTS = "Tests"
MODELS = "Models and studies"
DEFINITIONS = "Definitions"

app.command("run", rich_help_panel=TESTS)(run_command.run)
app.command("grade", rich_help_panel=TESTS)(grade_command.grade)
app.command("compare", rich_help_panel=TESTS)(compare_command.compare)
app.command("campaign", rich_help_panel=TESTS)(campaign_command.campaign)
app.command("certify", rich_help_panel=TESTS)(certify_command.certify)
app.command("report", rich_help_panel=TESTS)(report_command.report)
app.command("figure", rich_help_panel=TESTS)(figure_command.figure)
app.command("export", rich_help_panel=TESTS)(export_command.export)
app.command("verify", rich_help_panel=TESTS)(verify_command.verify)
app.add_typer(history_command.app, name="history", cls=WordedGroup, rich_help_panel=TESTS)
app.command("roundrobin", rich_help_panel=TESTS)(roundrobin_command.roundrobin)
app.command("extract", rich_help_panel=MODELS)(extract_command.extract)
app.command("calibrate", rich_help_panel=MODELS)(calibrate_command.calibrate)
app.command("study", rich_help_panel=MODELS)(study_command.study)
app.command("twin", rich_help_panel=MODELS)(twin_command.twin)
app.command("uncertainty", rich_help_panel=MODELS)(uncertainty_command.uncertainty)
app.command("confirm", rich_help_panel=DEFINITIONS)(confirm_command.confirm)
app.command("list", rich_help_panel=DEFINITIONS)(list_command.list_)
app.command("show", rich_help_panel=DEFINITIONS)(show_command.show)
app.command("validate", rich_help_panel=DEFINITIONS)(validate_command.validate)
app.command("schema", rich_help_panel=DEFINITIONS)(schema_command.schema)


for _group in (app, history_command.app):
    for _info in _group.registered_commands:
        _info.cls = WordedCommand


def _version(*, wanted: bool) -> None:
    if wanted:
        typer.echo(f"certkit {__version__}")
        raise typer.Exit


@app.callback()
def _options(
    *,
    version: Annotated[
        bool, typer.Option("--version", callback=lambda v: _version(wanted=v), is_eager=True, help="Show it.")
    ] = False,
) -> None:
    """Take the options that stand before a command."""
    del version


def _app_for(words: Sequence[str]) -> typer.Typer:
    """Return the app with as much of its commands as the words ask for: all options cost 20 ms to build."""
    first = words[0] if words else ""
    if first in {"-h", "--help"} or not (words or "_CERTKIT_COMPLETE" in os.environ):
        commands = [*map(_listed, app.registered_commands), *map(_listed, app.registered_groups)]
    else:
        commands = [command for command in app.registered_commands if command.name == first]
    if not commands:
        return app
    asked = copy.copy(app)
    asked.registered_commands, asked.registered_groups = commands, []
    return asked


def _listed(info: CommandInfo | TyperInfo) -> CommandInfo:
    """Return a command as the list of all of them shows it: without its options."""
    group = info.typer_instance.info.help if isinstance(info, TyperInfo) and info.typer_instance else None
    words = group or inspect.getdoc(info.callback)
    return CommandInfo(info.name, callback=lambda: None, help=words, rich_help_panel=info.rich_help_panel)


def _tell_remark(  # the signature of `warnings.showwarning`
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    """Say a warning in one line; one of certkit's own without the place in its code."""
    text = f"remark: {message}"
    if not issubclass(category, (OldFormWarning, LeftOutWarning)):
        text = warnings.formatwarning(message, category, filename, lineno, line).rstrip()
    typer.echo(text, file=file or sys.stderr)


def _words_of(error: OSError) -> str:
    """Say what could not be read or written, and what to do."""
    remedies = {
        errno.ENOSPC: "make room, or name another folder with `--out`",
        errno.EDQUOT: "make room, or name another folder with `--out`",
        errno.EROFS: "name another folder with `--out`",
        errno.EACCES: "ask for the right to it, or name another place",
        errno.EPERM: "ask for the right to it, or name another place",
        errno.ENAMETOOLONG: "take a shorter name",
        errno.ENOTDIR: "a file stands where a folder should be; name another",
        errno.EEXIST: "a file stands where a folder should be; name another",
        errno.EISDIR: "a folder stands where a file should be; name another",
        errno.ENOENT: "check the path",
    }
    place = f"{str(error.filename)[:200]}: " if error.filename else ""
    remedy = remedies.get(error.errno or 0, "check the place, and try again")
    return f"{place}{error.strerror or error}; {remedy}"


def main() -> None:
    """Run the command line and end with the contract's exit code."""
    # Imports and documents are many objects and hardly any garbage: to look for it every 700 costs 100 ms.
    gc.set_threshold(500_000)
    # Nor are pydantic's plugins wanted, which it looks for among all packages that are installed: 10 ms.
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    warnings.showwarning = _tell_remark
    guard_streams()
    if BASH.items() <= os.environ.items() and (offered := words_of_bash()) is not None:
        sys.stdout.write("\n".join(offered))
        return
    try:
        _app_for(sys.argv[1:])()
    except CertkitError as error:
        for line in str(error).splitlines():
            typer.echo(f"error: {line}", err=True)
        sys.exit(error.exit_code)
    except OSError as error:
        typer.echo(f"error: {_words_of(error)}", err=True)
        sys.exit(UsageError.exit_code)
    except Exception:  # noqa: BLE001  # Python's own exit code for a crash would read as the verdict `fail`
        traceback.print_exc()
        typer.echo(
            "error: this is a fault of certkit, not of your files; please report the lines above", err=True
        )
        sys.exit(CertkitError.exit_code)
    except KeyboardInterrupt:
        typer.echo("interrupted; nothing half-written is left behind", err=True)
        sys.exit(130)
    finally:
        end_streams()
        gc.freeze()  # no last look for garbage in a process that ends
