"""Read YAML that may come from anywhere: nothing is executed, nothing explodes, every value keeps its place.

PyYAML's parser (libyaml where it is built in) only cuts the text into events; what they mean is decided here,
because its own loaders let a later duplicate key win, follow tags, resolve scalars by YAML 1.1, and forget
the places.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import yaml
from msgspec import Struct, field

from certkit.definitions.loading.yaml_scalars import plain_scalar
from certkit.errors import DefinitionError, Problem
from certkit.files.limits import MAX_DEFINITION_BYTES, MAX_DEFINITION_DEPTH, MAX_DEFINITION_VALUES, MEGABYTE
from certkit.plain_text import odd_character

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.definitions.loading.faults import Steps

_START = "a definition starts with its kind, such as `procedure: my-test`"

_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

Place = tuple[int, int]
"""Line and column, one-based."""


class Tree(Struct, frozen=True):
    """A YAML file as plain data, with the place of each value and key.

    Parameters
    ----------
    file : str
        The file as the user named it.
    data : dict
        Mappings with string keys, lists, words, numbers, truth values and None.
    values, keys : dict
        Place of the value, and of the key, at the end of each path of keys and indices.
    problems : list of Problem
        What is wrong already, though it did not stop the reading (duplicate keys, tags).
    changed : dict
        Paths whose values do not come from the file, and where they come from.
    """

    file: str
    data: dict[str, Any]
    values: dict[Steps, Place]
    keys: dict[Steps, Place]
    problems: list[Problem]
    changed: dict[Steps, str] = field(default_factory=dict)

    def place(self, steps: Steps, *, key: bool = False) -> Place:
        """Return the place of the value at `steps` (or of its key), or of its nearest ancestor."""
        if key and steps in self.keys:
            return self.keys[steps]
        while steps not in self.values and steps:
            steps = steps[:-1]
        return self.values.get(steps, (1, 1))

    def problem(self, steps: Steps, message: str, *, key: bool = False) -> Problem:
        """Make a problem that stands at `steps`."""
        for end in range(len(steps), 0, -1):
            if steps[:end] in self.changed:
                return Problem(self.changed[steps[:end]], 0, 0, message)
        line, column = self.place(steps, key=key)
        return Problem(self.file, line, column, message)


def read_tree(data: bytes | str, file: str) -> Tree:
    """Read one YAML document whose top is a mapping.

    Parameters
    ----------
    data : bytes or str
        The file's content; bytes are UTF-8, with or without a byte order mark.
    file : str
        What the file is called in messages.

    Returns
    -------
    Tree

    Raises
    ------
    DefinitionError
        When it is no YAML, not UTF-8, too large, too deep, empty, several documents, or no mapping at its
        top.
    """
    return _remembered(data, file) if isinstance(data, bytes) else _read(data, file)


def _read(data: bytes | str, file: str) -> Tree:
    return _Reader(file, _events(_decode(data, file), file)).read()


_remembered = lru_cache(maxsize=32)(_read)
"""Reads a file's content once: nobody changes a tree, and a study reads the same files for every run."""


def read_value(text: str, file: str) -> Any:  # noqa: ANN401  # any plain data
    """Read one value as it could stand behind a key: `30 mm`, `12`, `{at: femur end, offset: 0 mm}`."""
    try:
        tree = read_tree(f"value: {text}", file)
    except DefinitionError as error:
        found = error.problems
    else:
        if not tree.problems and list(tree.data) == ["value"]:
            return tree.data["value"]
        found = tree.problems
    message = found[0].message if found else f"`{text}` is not one value"
    raise DefinitionError([Problem(file, 0, 0, message)])


def _decode(data: bytes | str, file: str) -> str:
    if len(data) > MAX_DEFINITION_BYTES:
        most = MAX_DEFINITION_BYTES // MEGABYTE
        message = f"is larger than {most} MB; definitions are small: is this the right file?"
        raise DefinitionError([Problem(file, 0, 0, message)])
    if isinstance(data, str):
        return data.removeprefix("\ufeff")
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise DefinitionError([Problem(file, 1, 1, "is saved as UTF-16; save it as UTF-8")])
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        before = data[: error.start]
        line, column = before.count(b"\n") + 1, error.start - before.rfind(b"\n")
        message = f"byte 0x{data[error.start]:02x} is not UTF-8; save the file as UTF-8"
        raise DefinitionError([Problem(file, line, column, message)]) from None


def _events(text: str, file: str) -> Iterator[Any]:
    """Yield the parser's events; what it cannot parse becomes a sentence for people."""
    try:
        yield from yaml.parse(text, Loader=_LOADER)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line, column = (mark.line + 1, mark.column + 1) if mark else (0, 0)
        raise DefinitionError([Problem(file, line, column, _syntax(error, text))]) from None
    except yaml.YAMLError as error:
        message = "holds a character that YAML does not allow (a control character?); remove it"
        position = getattr(error, "position", None)
        line = text.count("\n", 0, position) + 1 if isinstance(position, int) else 0
        raise DefinitionError([Problem(file, line, int(line > 0), message)]) from None
    except (RecursionError, ValueError):  # the parser's own limits, and what libyaml hands to Python
        raise DefinitionError([Problem(file, 0, 0, "cannot be read as YAML; correct the line")]) from None


def _syntax(error: yaml.MarkedYAMLError, text: str) -> str:
    said = f"{error.context or ''} {error.problem or ''}"
    number = error.problem_mark.line if error.problem_mark else 0
    line = "".join(text.split("\n")[number : number + 1])
    if "tab character" in said or "'\\t'" in said or line.lstrip(" ").startswith("\t"):
        return "a tab cannot indent YAML; use spaces"
    if "alias" in said:
        return f"{error.problem}; name it with & first, or write the value out"
    if "mapping values are not allowed" in said:
        return "a second `:` in one line; is a line break or a pair of quotes missing?"
    if "cannot start any token" in said:
        return "a value cannot start like this; put it in quotes"
    if "could not find expected ':'" in said or "expected ':'" in said:
        return "`:` is missing after a key"
    hint = "; check indentation, brackets and quotes here and in the line before"
    return f"is not YAML: {error.problem or error.context}{hint}"


class _Reader(Struct):
    """Builds the tree from events, at most `MAX_DEFINITION_DEPTH` deep and `MAX_DEFINITION_VALUES` large."""

    file: str
    events: Iterator[Any]
    values: dict[Steps, Place] = field(default_factory=dict)
    keys: dict[Steps, Place] = field(default_factory=dict)
    problems: list[Problem] = field(default_factory=list)
    anchors: dict[str, tuple[Any, int]] = field(default_factory=dict)
    nodes: int = 0

    def read(self) -> Tree:
        next(self.events)  # stream start
        event = next(self.events)
        if isinstance(event, yaml.StreamEndEvent):
            raise self._stop(event, f"is empty; {_START}")
        top = next(self.events)
        data = self._node(top, ())
        next(self.events)  # document end
        event = next(self.events)
        if not isinstance(event, yaml.StreamEndEvent):
            raise self._stop(event, "a second document starts here (`---`); put it into a file of its own")
        if not isinstance(data, dict):
            raise self._stop(top, f"is not a mapping; {_START}")
        return Tree(self.file, data, self.values, self.keys, self.problems)

    def _stop(self, event: Any, message: str) -> DefinitionError:  # noqa: ANN401  # PyYAML's events are untyped
        return DefinitionError([*self.problems, self._problem(event, message)])

    def _problem(self, event: Any, message: str) -> Problem:  # noqa: ANN401  # as above
        return Problem(self.file, *_place(event), message)

    def _node(self, event: Any, steps: Steps) -> Any:  # noqa: ANN401  # as above
        self._count(1, event)
        self._descend(len(steps), event)
        self.values[steps] = _place(event)
        if isinstance(event, yaml.AliasEvent):
            return self._alias(event, len(steps))
        if event.tag is not None:
            self.problems.append(self._problem(event, f"the tag `{event.tag}` is not used here; remove it"))
        before = self.nodes
        if isinstance(event, yaml.ScalarEvent):
            self._refuse_odd_characters(event)
            data: Any = plain_scalar(event.value) if event.implicit[0] else event.value
        elif isinstance(event, yaml.SequenceStartEvent):
            data = self._list(steps)
        else:
            data = self._mapping(steps)
        if event.anchor is not None:
            self.anchors[event.anchor] = (data, self.nodes - before + 1)
        return data

    def _refuse_odd_characters(self, event: Any) -> None:  # noqa: ANN401  # as above
        odd = odd_character(event.value)
        if odd is not None:
            message = (
                f"holds the control character U+{ord(odd):04X}; terminals and reports break on it: remove it"
            )
            self.problems.append(self._problem(event, message))

    def _list(self, steps: Steps) -> list[Any]:
        items: list[Any] = []
        while not isinstance(event := next(self.events), yaml.SequenceEndEvent):
            items.append(self._node(event, (*steps, len(items))))
        return items

    def _mapping(self, steps: Steps) -> dict[str, Any]:
        entries: dict[str, Any] = {}
        while not isinstance(event := next(self.events), yaml.MappingEndEvent):
            if not isinstance(event, yaml.ScalarEvent):
                raise self._stop(event, "a key has to be a word")
            self._count(1, event)
            self._refuse_odd_characters(event)
            key, path = event.value, (*steps, event.value)
            if key in entries:
                first = self.keys[path][0]
                message = f"`{key}` stands here twice (first in line {first}); keep one"
                self.problems.append(self._problem(event, message))
                self._node(next(self.events), (*steps, f"{key} (again)"))
            else:
                self.keys[path] = _place(event)
                entries[key] = self._node(next(self.events), path)
        return entries

    def _alias(self, event: Any, level: int) -> Any:  # noqa: ANN401  # as above
        if event.anchor not in self.anchors:  # unknown, or inside the very value it names
            raise self._stop(event, f"`*{event.anchor}` names no value before it; write the value out")
        data, size = self.anchors[event.anchor]
        self._count(size, event)
        self._descend(level + _depth(data), event)
        return _copy(data)

    def _descend(self, level: int, event: Any) -> None:  # noqa: ANN401  # as above
        if level > MAX_DEFINITION_DEPTH:
            raise self._stop(event, f"is nested more than {MAX_DEFINITION_DEPTH} levels deep")

    def _count(self, more: int, event: Any) -> None:  # noqa: ANN401  # as above
        self.nodes += more
        if self.nodes > MAX_DEFINITION_VALUES:
            message = (
                f"holds more than {MAX_DEFINITION_VALUES} values, counting aliases with all they stand for"
            )
            raise self._stop(event, message)


def _place(event: Any) -> Place:  # noqa: ANN401  # as above
    return (event.start_mark.line + 1, event.start_mark.column + 1)


def _depth(data: Any) -> int:  # noqa: ANN401  # any plain data
    entries = data.values() if isinstance(data, dict) else data if isinstance(data, list) else ()
    return max((1 + _depth(entry) for entry in entries), default=0)


def _copy(data: Any) -> Any:  # noqa: ANN401  # any plain data
    """Copy mappings and lists, so that nothing is shared between two places of the tree."""
    if isinstance(data, dict):
        return {key: _copy(value) for key, value in data.items()}
    if isinstance(data, list):
        return [_copy(value) for value in data]
    return data
