"""Change values of a definition for one run: `{"rig.hinge.offset": "30 mm", "criteria.T1.filter": "none"}`.

A path is words with dots between them. Underscores and hyphens stand for spaces. List entries have names: a
criterion its id, a precondition its quantity, a point its coordinates (`x`, `z`), a point of a curve its
abscissa (`loading.28 mm` is the force there). Their numbers, from 1, are an old way to name them; only where
an entry has no name of its own is its number the way.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from certkit.definitions.loading.error_messages import nearest, plain, suggestion
from certkit.definitions.loading.field_types import FieldType, fields
from certkit.definitions.loading.yaml_reader import Tree, read_value
from certkit.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from pydantic import BaseModel

    from certkit.definitions.loading.faults import Steps

Overrides = Mapping[str, object]
"""Values by their paths: words as in a definition file (`"30 mm"`), or numbers, truth values and lists."""

ORIGIN = {"source": "set on the command line", "confidence": "estimated"}


class Change(Struct, frozen=True):
    """A value that was changed.

    Parameters
    ----------
    path : str
        Where, in the words of the file.
    value : str
        What it is now.
    was : str, optional
        What the file says; None where it says nothing.
    remark : str
        What to write instead of an old path; empty for a path of today.
    """

    path: str
    value: str
    was: str | None
    remark: str = ""


class _Spot(Struct, frozen=True):
    """Where a path leads: the steps in the file's words, what stands there, the part that has its origin."""

    steps: Steps
    words: str
    shape: FieldType
    sourced: Steps | None
    numbered: bool = False


class _Entry(Struct, frozen=True):
    """Something that can be named below a value: the steps to it, what it holds, its name of today.

    `numbered` where it was named by its number though it has a name.
    """

    steps: Steps
    shape: FieldType
    value: Any
    word: str
    numbered: bool = False


def overrides_from(words: Iterable[str]) -> dict[str, str]:
    """Return overrides as they are written on a command line, `path=value` each; the last of a path holds.

    Raises
    ------
    UsageError
        When there is no `=`, or nothing before it.
    """
    found: dict[str, str] = {}
    for override in words:
        path, sign, value = override.partition("=")
        if not sign or not path.strip():
            raise UsageError(f"`--set {override}`: write PATH=VALUE, such as 'rig.hinge.offset=30 mm'")
        found.pop(path.strip(), None)  # so that it is applied after the others, as it was written
        found[path.strip()] = value.strip()
    return found


def change(
    tree: Tree, overrides: Overrides, model: type[BaseModel], prefix: str = ""
) -> tuple[Tree, tuple[Change, ...]]:
    """Return the tree with the values changed, and what was changed.

    Parameters
    ----------
    tree : Tree
        A definition as read; it is left as it is.
    overrides : mapping of str to value
        Values by their paths; applied in turn.
    model : type
        The definition's document, which also knows the keys that are not in the file.
    prefix : str
        What stands before such paths on the command line: `legform.`.

    Raises
    ------
    UsageError
        When a path does not exist; names the nearest one.
    DefinitionError
        When a value cannot be read.
    """
    data, changed, changes = tree.data, dict(tree.changed), []
    for path, given in overrides.items():
        text = given if isinstance(given, str) else json.dumps(given, ensure_ascii=False)  # YAML as well
        spot = _find(path, data, model)
        value = read_value(text, f"--set {path}")
        was = _at(data, spot.steps)
        data = _with(data, spot.steps, _sourced(value, spot.shape))
        if spot.sourced is not None and spot.steps[-1] not in ORIGIN:
            for key, said in ORIGIN.items():
                data = _with(data, (*spot.sourced, key), said)
        changed[spot.steps] = f"--set {path}"
        remark = f"`{prefix}{path}` is an old path; write `{prefix}{spot.words}`" if spot.numbered else ""
        changes.append(Change(spot.words, _shown(value), None if was is None else _shown(was), remark))
    return replace(tree, data=data, changed=changed), tuple(changes)


def words_of(path: str, data: Any, model: type[BaseModel]) -> str:  # noqa: ANN401  # raw YAML data
    """Return a path in the words of today, with names instead of numbers.

    Raises
    ------
    UsageError
        When it does not exist; names the nearest one.
    """
    return _find(path, data, model).words


def known_paths(data: Any, shape: FieldType, prefix: str = "") -> Iterator[str]:  # noqa: ANN401  # raw YAML data
    """Yield the paths of all values that a definition has or could have."""
    for name, entry in _below(data, shape).items():
        if entry.numbered:
            continue
        path = f"{prefix}.{name}" if prefix else name
        yield path
        yield from known_paths(entry.value, entry.shape, path)


def _begins(path: str, name: str) -> bool:
    """Tell whether a path goes on with a name; any path does where it is empty."""
    word = plain(name)
    return not path or path == word or path.startswith(f"{word}.")


def _below(data: Any, shape: FieldType, path: str = "") -> dict[str, _Entry]:  # noqa: ANN401  # raw YAML data
    """Return what can be named below a value, at least what a path that goes on so can mean."""
    if shape.model is not None:
        given = data if isinstance(data, dict) else {}
        known = {key: inner for key, inner in fields(shape.model).items() if _begins(path, key)}
        return {key: _Entry((key,), inner, given.get(key), key) for key, inner in known.items()}
    if shape.item is None:
        return {}
    if isinstance(data, dict):
        meant = {str(key): (key, value) for key, value in data.items() if _begins(path, str(key))}
        return {word: _Entry((key,), shape.item, value, word) for word, (key, value) in meant.items()}
    below: dict[str, _Entry] = {}
    for index, value in enumerate(data if isinstance(data, list) else ()):
        for entry_name, entry in _list_entries(index, value, shape):
            below.setdefault(entry_name, entry)
    return below


def _list_entries(index: int, value: Any, shape: FieldType) -> Iterator[tuple[str, _Entry]]:  # noqa: ANN401  # raw YAML data
    """Yield the names of a list's entry: its own, and its number."""
    item, number = shape.item or FieldType("plain"), str(index + 1)
    if item.kind == "list" and item.item is not None and isinstance(value, list) and len(value) == 2:
        # A point of a curve: its ordinate is named by its abscissa.
        at = _shown(value[0])
        ordinate = _Entry((index, 1), item.item, value[1], at)
        yield at, ordinate
        yield f"{number}.2", replace(ordinate, numbered=True)
        yield f"{number}.1", _Entry((index, 0), item.item, value[0], f"{number}.1")
        return
    own = (value.get("id") or value.get("quantity")) if isinstance(value, dict) else None
    if shape.axes and index < len(shape.axes):
        own = shape.axes[index]
    name = own if isinstance(own, str) else number
    yield name, _Entry((index,), item, value, name)
    if name != number:
        yield number, _Entry((index,), item, value, name, numbered=True)


def _find(path: str, data: Any, model: type[BaseModel]) -> _Spot:  # noqa: ANN401  # raw YAML data
    """Follow a path; names may hold dots themselves, so the longest name that fits is taken."""
    top, rest = data, plain(path)
    shape = FieldType("document", model=model)
    steps: list[str | int] = []
    words: list[str] = []
    sourced: Steps | None = None
    numbered = False
    while rest:
        below = _below(data, shape, rest)
        fitting = [name for name in below if _begins(rest, name)]
        if not fitting:
            below = _below(data, shape)
            near = nearest(path, list(known_paths(top, FieldType("document", model=model))))
            there = [".".join([*words, name]) for name, entry in below.items() if not entry.numbered]
            hint = f"did you mean `{near}`?" if near else suggestion(path, there)
            raise UsageError(f"`--set {path}`: there is no such value; {hint}")
        name = max(fitting, key=len)
        if shape.model is not None and set(ORIGIN) <= set(fields(shape.model)):
            sourced = tuple(steps)
        found = below[name]
        shape, data, numbered = found.shape, found.value, numbered or found.numbered
        steps.extend(found.steps)
        words.append(found.word)
        rest = rest[len(plain(name)) + 1 :]
    return _Spot(tuple(steps), ".".join(words), shape, sourced, numbered)


def _sourced(value: Any, shape: FieldType) -> Any:  # noqa: ANN401  # raw YAML data
    """Give numbers their origin."""
    if shape.kind == "number" and isinstance(value, (str, int, float)):
        return {"value": value, **ORIGIN}
    if shape.kind == "list" and shape.item is not None and isinstance(value, list):
        return [_sourced(entry, shape.item) for entry in value]
    if shape.model is not None and "origin" in fields(shape.model) and isinstance(value, dict):
        return {"origin": ORIGIN, **value}
    return value


def _at(data: Any, steps: Steps) -> Any:  # noqa: ANN401  # raw YAML data
    """Return the value at `steps`, None where the file has none."""
    for step in steps:
        if isinstance(data, dict):
            data = data.get(step)
        elif isinstance(data, list) and isinstance(step, int):
            data = data[step]
    return data


def _with(data: Any, steps: Steps, value: Any) -> Any:  # noqa: ANN401  # raw YAML data
    """Return a copy of the tree with one value exchanged; mappings on the way are made where missing."""
    if not steps:
        return value
    step, rest = steps[0], steps[1:]
    if isinstance(data, list) and isinstance(step, int):
        return [*data[:step], _with(data[step], rest, value), *data[step + 1 :]]
    known = data if isinstance(data, dict) else {}
    return {**known, step: _with(known.get(step), rest, value)}


def _shown(value: Any) -> str:  # noqa: ANN401  # raw YAML data
    """Return a value as people write it."""
    if value is None:
        return "none"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        if "value" in value:
            return str(value["value"])
        return "{" + ", ".join(f"{key}: {_shown(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_shown, value)) + "]"
    return str(value)
