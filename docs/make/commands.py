"""The page of commands, from the command line itself."""

from __future__ import annotations

import textwrap
from typing import Any

import typer

from certkit.cli.commands import whole_app
from docs.make.markdown import anchor, page, table

HEAD = """\
# Commands

Made from the command line itself; `certkit COMMAND --help` says the same."""


def commands() -> str:
    """Return the page: every command with its arguments and options."""
    group = typer.main.get_command(whole_app())
    parts = [HEAD, _exit_codes(group)]
    for words, command in _walk(group, ()):
        name = " ".join(words)
        usage = " ".join(["certkit", *words, *_pieces(command)])
        parts += [
            f"## {name} {{ #{anchor(name)} }}",
            f"```text\n{usage}\n```",
            textwrap.dedent(command.help or "").strip(),
            table(
                ("", "what", "default"), [_row(p) for p in command.params if not getattr(p, "hidden", False)]
            ),
        ]
    return page(*parts)


def _walk(group: Any, words: tuple[str, ...]) -> list[tuple[tuple[str, ...], Any]]:  # noqa: ANN401  # typer's own copy of click has no public types
    found = []
    for name, command in group.commands.items():
        if getattr(command, "hidden", False):
            continue
        if hasattr(command, "commands"):
            found += _walk(command, (*words, name))
        else:
            found.append(((*words, name), command))
    return found


def _exit_codes(group: Any) -> str:  # noqa: ANN401  # as above
    said = (group.epilog or "").removeprefix("Exit codes: ").rstrip(".")
    rows = [piece.strip().split(" ", 1) for piece in said.split("·")]
    return table(("exit code", "meaning"), rows)


def _pieces(command: Any) -> list[str]:  # noqa: ANN401  # as above
    pieces = []
    for parameter in command.params:
        if parameter.param_type_name == "argument":
            name = _metavar(parameter)
            pieces.append(name if parameter.required else f"[{name}]")
        elif parameter.required:
            pieces.append(f"{parameter.opts[0]} {_metavar(parameter)}")
    return [*pieces, "[OPTIONS]"]


def _metavar(parameter: Any) -> str:  # noqa: ANN401  # as above
    name = parameter.metavar or parameter.name.upper()
    many = parameter.param_type_name == "argument" and parameter.nargs == -1
    return f"{name} …" if many and "…" not in name and "..." not in name else str(name)


def _row(parameter: Any) -> tuple[str, str, str]:  # noqa: ANN401  # as above
    if parameter.param_type_name == "argument":
        return f"`{_metavar(parameter)}`", parameter.help or "", "required" if parameter.required else ""
    names = " ".join(f"`{name}`" for name in parameter.opts)
    if not parameter.is_flag:
        value = parameter.metavar or ("N" if _is_number(parameter) else _word(parameter.opts[0]))
        names += f" `{value}`"
    return names, parameter.help or "", _default(parameter)


def _word(option: str) -> str:
    return {"--out": "FOLDER", "--format": "LIST", "--table": "LIST"}.get(
        option, option.strip("-").upper().replace("-", " ")
    )


def _is_number(parameter: Any) -> bool:  # noqa: ANN401  # as above
    return getattr(parameter, "min", None) is not None


def _default(parameter: Any) -> str:  # noqa: ANN401  # as above
    if parameter.required:
        return "required"
    if isinstance(parameter.show_default, str):
        return parameter.show_default
    given = parameter.default
    if given is None or isinstance(given, (bool, list, tuple)) or callable(given):
        return ""
    return f"`{getattr(given, 'value', given)}`"
