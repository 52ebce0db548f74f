"""A definition as one reads it: head, criteria with their corridors, every number with its origin, notes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import asdict

from certkit.definitions.corridor_set import CorridorSet
from certkit.definitions.loading.error_messages import suggestion
from certkit.definitions.loading.kinds import KINDS, kind_of
from certkit.definitions.loading.library import load, names
from certkit.definitions.loading.lint import kind_in
from certkit.definitions.loading.parameter_list import ListedParameter, parameters
from certkit.definitions.loading.search_path import is_path
from certkit.definitions.loading.validation import read_bytes
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.definitions.procedure import Procedure
from certkit.errors import UsageError

if TYPE_CHECKING:
    from pydantic import BaseModel

    from certkit.definitions.loading.library import Library, Loaded
    from certkit.definitions.loading.overrides import Overrides
    from certkit.definitions.procedure import Criterion


class Sheet(Struct, frozen=True):
    """What there is to read about a definition; every entry is words.

    Parameters
    ----------
    kind, noun, name : str
        `corridors`, `corridor set`, `r127-pendulum`.
    head : tuple of str
        Title, method, file and the like, a line each.
    criteria : tuple of tuple
        Of a procedure: id, what is measured, what it has to be, confidence, source.
    numbers : tuple of Parameter
        Every number.
    awaited : tuple of tuple
        Of a corridor set: name, and why it is not here.
    notes : tuple of str
        Its notes.
    document : dict
        The definition itself, as plain data.
    """

    kind: str
    noun: str
    name: str
    head: tuple[str, ...]
    criteria: tuple[tuple[str, ...], ...]
    numbers: tuple[ListedParameter, ...]
    awaited: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...]
    document: dict[str, Any]

    def as_data(self) -> dict[str, Any]:
        """Return the definition and its numbers as plain data."""
        heads = ("id", "measured", "corridor", "confidence", "source")
        return {
            "kind": self.kind,
            "name": self.name,
            "criteria": [dict(zip(heads, row, strict=True)) for row in self.criteria],
            "numbers": [asdict(number) for number in self.numbers],
            "document": self.document,
        }


def sheet(
    name: str, kind: str | None = None, *, library: Library = (), overrides: Overrides | None = None
) -> Sheet:
    """Load a definition by name or path and lay it out.

    Raises
    ------
    UsageError
        When no definition has the name.
    DefinitionError
        When the file has problems.
    """
    word = kind_of(kind).word if kind else _kind_with(name, library)
    loaded = load(word, name, library=library, overrides=overrides)
    document = loaded.document
    return Sheet(
        kind=word,
        noun=KINDS[word].noun,
        name=loaded.name,
        head=tuple(_head(loaded)),
        criteria=tuple(_criteria(document, library)) if isinstance(document, Procedure) else (),
        numbers=tuple(parameters(document)),
        awaited=tuple(document.awaited.items()) if isinstance(document, CorridorSet) else (),
        notes=tuple(getattr(document, "notes", ())),
        document=document.model_dump(mode="json", exclude_none=True),
    )


def _kind_with(name: str, library: Library) -> str:
    if is_path(name):
        return kind_in(read_tree(read_bytes(Path(name)), name)).word
    known = {kind.word: names(kind.word, library) for kind in KINDS.values() if kind.folder}
    having = [word for word, there in known.items() if name in there]
    if having:
        return having[0]  # a leg before the fit that made it; `kind` asks for another one
    every = [each for there in known.values() for each in there]
    raise UsageError(f"there is no definition `{name}`; {suggestion(name, every)}")


def _head(loaded: Loaded[BaseModel]) -> list[str]:
    document = loaded.document
    lines = [str(getattr(document, "title", "")), f"file: {loaded.path}"]
    if isinstance(document, Procedure):
        specimen = document.specimen
        lines.append(f"method: {document.method.words}")
        lines.append(f"specimen: {specimen.part} of {specimen.legform}, flesh {specimen.flesh}")
        lines += [
            f"{word}: {name}"
            for word in ("vehicle", "reference", "score")
            if (name := getattr(document, word))
        ]
    lines += [f"changed: {c.path} = {c.value} (was {c.was or 'not given'})" for c in loaded.overrides]
    return [line for line in lines if line]


def _criteria(procedure: Procedure, library: Library) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    for criterion in procedure.criteria:
        measured: str = criterion.measure
        if criterion.channel is not None:
            measured = f"{measured} of {criterion.channel}"
        if criterion.curve is not None:
            measured = f"{criterion.curve.y} over {criterion.curve.x}"
        if criterion.at is not None:
            measured = f"{measured} where {criterion.at.channel} reaches {criterion.at.equals}"
        if criterion.filter != "none":
            measured = f"{measured}, {criterion.filter}"
        rows.append((criterion.id, measured, *_corridor(criterion, library)))
    return rows


def _corridor(criterion: Criterion, library: Library) -> tuple[str, str, str]:
    """Return limits, confidence and source of a criterion's corridor."""
    if criterion.corridor is None:
        return ("shown, not graded", "", "")
    name, _, entry = criterion.corridor.partition("/")
    try:
        corridor = load("corridors", name, library=library).document.entry(entry)
    except (UsageError, KeyError):
        return (f"{criterion.corridor}: missing", "", "")
    if corridor is None:
        return ("shown until a corridor is supplied", "", criterion.corridor)
    return (", ".join(corridor.lines().values()), corridor.confidence or "", corridor.source or "")
