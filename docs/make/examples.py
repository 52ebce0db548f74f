"""What a page shows: files that it gives, commands to type, and scripts, in their order."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

BLOCK = re.compile(r"^```(yaml|console|python)[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
PROGRAMS = ("certkit", "cp", "export", "gunzip", "mkdir")


@dataclass(frozen=True)
class Given:
    """A file that a page gives: a `yaml` block that begins with `# file: NAME`."""

    name: str
    text: str


@dataclass(frozen=True)
class Typed:
    """A command that a page shows: a line `$ certkit …` in a `console` block.

    Parameters
    ----------
    words : str
        The command.
    keeps : str
        File that takes what it prints, from `> FILE` at its end; empty when there is none.
    ends_with : int
        Exit code, from the comment `# exit N`; 0 when there is none.
    """

    words: str
    keeps: str
    ends_with: int


@dataclass(frozen=True)
class Script:
    """A `python` block; all of a page are run one after the other, and know what those before them know."""

    text: str


def examples(page: Path) -> list[Given | Typed | Script]:
    """Return the examples of a page."""
    found: list[Given | Typed | Script] = []
    for kind, text in BLOCK.findall(page.read_text()):
        if kind == "yaml" and text.startswith("# file: "):
            found.append(Given(text.splitlines()[0].removeprefix("# file: ").strip(), text))
        if kind == "python":
            found.append(Script(text))
        if kind == "console":
            found += [_typed(line[2:]) for line in text.splitlines() if _is_run(line)]
    return found


def _is_run(line: str) -> bool:
    return line.startswith(tuple(f"$ {program} " for program in PROGRAMS))


def _typed(line: str) -> Typed:
    text, _, code = line.partition("  # exit ")
    words, _, keeps = text.partition(" > ")
    return Typed(words.strip(), keeps.strip(), int(code or 0))
