"""JSON Schemas in words: what stands under each key of a document."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from docs.make.markdown import anchor, page, table

if TYPE_CHECKING:
    from collections.abc import Iterator

Schema = dict[str, Any]

PLAIN = {
    "string": "text",
    "number": "number",
    "integer": "whole number",
    "boolean": "true or false",
    "object": "anything by name",
    "null": "nothing",
}


@dataclass(frozen=True)
class Part:
    """A part of a document that has a table of its own.

    Parameters
    ----------
    name : str
        Its name in the schema's `$defs`.
    places : list of str
        Where it stands in the document: `rig.ram`, `femur`, `tibia`.
    """

    name: str
    places: list[str]


def parts(root: Schema, *, skip: frozenset[str] = frozenset()) -> list[Part]:
    """List the parts of a document in the order in which a reader of the file meets them."""
    found: dict[str, list[str]] = {}

    def visit(schema: Schema, place: str) -> None:
        for key, value in schema.get("properties", {}).items():
            for name, suffix in _references(value):
                if name in skip:
                    continue
                where = ".".join(part for part in (place, key) if part) + suffix
                known = name in found
                found.setdefault(name, []).append(where)
                if not known:
                    visit(root["$defs"][name], where)

    visit(root, "")
    return [Part(name, places) for name, places in found.items()]


def described(root: Schema, word: str, *, depth: int, skip: frozenset[str] = frozenset()) -> str:
    """Return the tables of a document: its own keys, then those of each part.

    Parameters
    ----------
    root : dict
        The JSON Schema with `$defs`.
    word : str
        What the anchors on the page begin with.
    depth : int
        Level of the parts' headings.
    skip : frozenset of str
        Names in `$defs` whose keys are left out: the page says once what they are.
    """
    sections = [_table(root, word, skip)]
    for part in parts(root, skip=skip):
        schema = root["$defs"][part.name]
        places = ", ".join(f"`{place}`" for place in part.places)
        sections += [
            f"{'#' * depth} {places} {{ #{anchor(word, part.name)} }}",
            schema.get("description", ""),
            _table(schema, word, skip),
        ]
    return page(*sections)


def _table(schema: Schema, word: str, skip: frozenset[str]) -> str:
    required = set(schema.get("required", ()))
    rows = [
        (f"`{key}`", phrase(value, word), value.get("description", ""), _default(value, key in required))
        for key, value in schema["properties"].items()
        if skip.isdisjoint(name for name, _ in _references(value))
    ]
    return table(("key", "holds", "meaning", "default"), rows)


def _default(value: Schema, required: bool) -> str:  # noqa: FBT001  # one caller
    if required:
        return "required"
    given = value.get("default")
    if given is None or given in ([], {}, "") or isinstance(given, dict):
        return ""
    return f"`{str(given).lower() if isinstance(given, bool) else given}`"


def phrase(value: Schema, word: str) -> str:
    """Say in words what a schema allows: `length`, `list of text`, `one of pinned, free`."""
    if "$ref" in value:
        name = value["$ref"].rsplit("/", 1)[1]
        return f"[{_spaced(name)}](#{anchor(word, name)})"
    choices = value.get("anyOf") or value.get("oneOf") or []
    if choices:
        options = [option for option in choices if option.get("type") != "null"]
        if dimension := _dimension(options):
            return dimension
        return " or ".join(dict.fromkeys(phrase(option, word) for option in options))
    if "const" in value:
        return f"`{value['const']}`"
    if "enum" in value:
        return "one of " + ", ".join(f"`{choice}`" for choice in value["enum"])
    return _container(value, word) or _scalar(value)


def _container(value: Schema, word: str) -> str:
    if value.get("type") == "array":
        if "prefixItems" in value:
            return "(" + ", ".join(phrase(item, word) for item in value["prefixItems"]) + ")"
        inner = phrase(value["items"], word) if value.get("items") else "anything"
        low, high = value.get("minItems"), value.get("maxItems")
        count = f"{low} × " if low is not None and low == high else "list of "
        return f"{count}{inner}"
    extra = value.get("additionalProperties")
    if value.get("type") == "object" and isinstance(extra, dict) and extra:
        return f"by name: {phrase(extra, word)}"
    return ""


def _scalar(value: Schema) -> str:
    kind = value.get("type")
    if isinstance(kind, list):  # a word in YAML may look like a number
        return "text"
    if kind is None:
        return "anything"
    said = "day" if value.get("format") == "date" else PLAIN[kind]
    low = value.get("minimum", value.get("exclusiveMinimum"))
    high = value.get("maximum", value.get("exclusiveMaximum"))
    if low is None and high is None:
        return said
    if high is None:
        return f"{said} {'>' if 'exclusiveMinimum' in value else '≥'} {low:g}"
    start = f"{low:g}" if low is not None else "−∞"
    return f"{said}, {start} to {high:g}"


def _dimension(options: list[Schema]) -> str:
    """Return `length` for a number with unit and origin, which the schema describes in two ways."""
    for option in options:
        said = option.get("description", "")
        if option.get("type") == ["string", "number"] and said.startswith("A ") and "examples" in option:
            return f"*{said.removeprefix('A ').rstrip('.')}*"
        if inner := _dimension(option.get("anyOf", [])):
            return inner
    return ""


def _references(value: Schema) -> Iterator[tuple[str, str]]:
    """Find the parts that a value names, and what to add to its place: `.NAME` for a mapping."""
    if "$ref" in value:
        yield value["$ref"].rsplit("/", 1)[1], ""
    for option in (*value.get("anyOf", ()), *value.get("oneOf", ())):
        yield from _references(option)
    if isinstance(value.get("items"), dict):
        yield from _references(value["items"])
    for item in value.get("prefixItems", ()):
        yield from _references(item)
    if isinstance(value.get("additionalProperties"), dict):
        for name, suffix in _references(value["additionalProperties"]):
            yield name, f".NAME{suffix}"


def _spaced(name: str) -> str:
    """Turn `AddedMass` into `added mass`."""
    spaced = "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in name)
    return spaced.strip().rstrip("_")
