"""Another value in a definition's text, at its place: all else stays as it was written."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.overrides import change
from certkit.definitions.loading.validation import validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.errors import DefinitionError, UsageError

if TYPE_CHECKING:
    from pydantic import BaseModel

    from certkit.definitions.loading.library import Loaded
    from certkit.definitions.loading.parameter_list import ListedParameter

_WINDOW = re.compile(
    r"(?P<lower>.+?) to (?P<upper>.+)|(?:at most|below) (?P<most>.+)|(?:at least|above) (?P<least>.+)"
)


def with_value(loaded: Loaded[BaseModel], entry: ListedParameter, value: str) -> str:
    """Return a definition's text with another value at a number's place; all else stays as it was written.

    Raises
    ------
    UsageError
        When the value does not fit, or the number is a polygon or curve.
    """
    kind = KINDS[loaded.kind]
    tree = read_tree(loaded.text, loaded.path)
    lines = loaded.text.splitlines(keepends=True)
    for path, new in _parts(entry, value).items():
        try:
            changed, (spot,) = change(tree, {path: new}, kind.model)
            validate(changed, kind.model)
        except DefinitionError as error:
            raise UsageError(f"`{value}` does not fit: {error.problems[0].message}") from error
        steps = next(steps for steps in changed.changed if steps not in tree.changed)
        line, column = tree.values[steps]
        old, text = spot.was or "", lines[line - 1]
        for written in (old, f'"{old}"', f"'{old}'"):
            if old and text[column - 1 :].startswith(written):
                lines[line - 1] = text[: column - 1] + new + text[column - 1 + len(written) :]
                break
        else:
            raise UsageError(f"{loaded.path}:{line}:{column}: change this value in the file, then confirm it")
    return "".join(lines)


def _parts(entry: ListedParameter, value: str) -> dict[str, str]:
    """Return the paths that a value is written at: a corridor has two."""
    was, now = _sides(entry.value), _sides(value)
    if not was:
        return {entry.path: value}
    if was.keys() != now.keys():
        raise UsageError(f"{entry.path}: write the corridor like `{entry.value}`")
    return {f"{entry.path}.{side}": new for side, new in now.items() if new != was[side]}


def _sides(words: str) -> dict[str, str]:
    """Return the sides of a corridor that is told in words; empty for a plain number."""
    found = _WINDOW.fullmatch(words)
    given = {} if found is None else {side: text for side, text in found.groupdict().items() if text}
    names_of = {"lower": "lower", "upper": "upper", "most": "upper", "least": "lower"}
    return {names_of[side]: text for side, text in given.items()}
