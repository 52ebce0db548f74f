"""What help calls the value of an option: a word of ours, and nothing behind a switch."""

from __future__ import annotations

from typing import Any

from typer.core import TyperCommand, TyperGroup

WORDS = {"--out": "FOLDER", "--format": "LIST", "--table": "LIST"}
"""Values that are not called after their option."""


def value_word(parameter: Any) -> str:  # noqa: ANN401  # typer names its classes differently from version to version
    """Return what a parameter's value is called: `PROCESSES`, `FOLDER`, `N`; empty for a switch."""
    if parameter.metavar is not None:
        return str(parameter.metavar)
    if parameter.param_type_name == "argument" or getattr(parameter, "is_flag", False):
        return ""
    if getattr(parameter, "min", None) is not None:
        return "N"
    longest: str = max(parameter.opts, key=len)
    return WORDS.get(longest, longest.strip("-").upper().replace("-", " "))


class WordedHelp:
    """Lets help have words where typer writes the names of Python's types."""

    def get_params(self, ctx: Any) -> list[Any]:  # noqa: ANN401  # as above, of contexts
        """Return the parameters, each with the word for its value."""
        found: list[Any] = list(super().get_params(ctx))  # type: ignore[misc]  # of the class it is mixed into
        for parameter in found:
            word = value_word(parameter)
            if parameter.param_type_name == "argument":
                parameter.display_type_rich = lambda **_: ""  # its own word stands before it
            elif parameter.metavar is None:
                parameter.metavar = word
        return found


class WordedCommand(WordedHelp, TyperCommand):
    """A command whose help has words."""


class WordedGroup(WordedHelp, TyperGroup):
    """A group of commands whose help has words."""
