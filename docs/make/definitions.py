"""The page of definition files: every key of every kind, from the schemas that also check the files."""

from __future__ import annotations

import inspect

from certkit.definitions.loading.json_schema import schema_of
from certkit.definitions.loading.kinds import KINDS, Kind
from certkit.definitions.loading.library import names
from certkit.definitions.units import UNITS
from docs.make.markdown import anchor, page, table
from docs.make.schema import described

HEAD = """\
# Definition files

Everything that certkit works on is a YAML file whose first key says what kind it is and whose value is its
name. Unknown keys are errors. `certkit validate FILE` tells every problem at once with its line and column,
and `certkit schema KIND` prints the JSON Schema with which an editor completes and checks the file.

A *length*, a *mass* and so on in the tables below is a number with its unit and its origin:
`{value: 25 mm, source: our drawing 1234, confidence: verified}`. Any section may carry an `origin:
{source: …, confidence: …}`. It covers all bare numbers below it, so that `25 mm` is enough there; a
procedure's numbers take its `method` as their origin. The confidences are explained under
[Words](words.md#confidence)."""

ORIGIN = frozenset({"Origin"})


def definitions() -> str:
    """Return the page."""
    kinds = list(KINDS.values())
    rows = [
        (f"[`{kind.word}`](#{anchor(kind.word)})", kind.title, _folder(kind), _shipped(kind))
        for kind in kinds
    ]
    sections = [
        HEAD,
        table(("first key", "what it is", "folder in a library", "shipped"), rows),
        "## Units",
        table(("quantity", "units"), [(name, _units(name)) for name in UNITS if _units(name)]),
    ]
    for kind in kinds:
        schema = schema_of(kind)
        sections += [
            f"## {kind.word} {{ #{anchor(kind.word)} }}",
            inspect.cleandoc(kind.model.__doc__ or ""),  # Python 3.13 takes the margin off by itself
            described(schema, kind.word, depth=3, skip=ORIGIN),
        ]
    return page(*sections)


def _folder(kind: Kind) -> str:
    return f"`{kind.folder}`" if kind.folder else "named by its path"


def _shipped(kind: Kind) -> str:
    return ", ".join(names(kind.word)) if kind.folder else ""


def _units(name: str) -> str:
    return ", ".join(f"`{unit}`" for unit in UNITS[name] if unit)
