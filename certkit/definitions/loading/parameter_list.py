"""All numbers of a document in one list, each with its origin: what a report prints and `show` lists."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct
from pydantic import BaseModel

from certkit.definitions.base import Sourced, words
from certkit.definitions.loading.field_types import axes_of
from certkit.definitions.provenance import Confidence, Number

if TYPE_CHECKING:
    from collections.abc import Iterator


class ListedParameter(Struct, frozen=True):
    """A number or corridor with its origin.

    Parameters
    ----------
    path : str
        In the words of the file: `rig.hinge.offset`.
    value : str
        As it was written, with its unit.
    source : str
        Text, test or fit it comes from.
    confidence : str
        How far that can be trusted.
    """

    path: str
    value: str
    source: str
    confidence: Confidence


def parameters(document: BaseModel) -> list[ListedParameter]:
    """List every number of a document, in the order of the file."""
    return list(_walk(document, ""))


def curve_points(document: BaseModel) -> dict[str, str]:
    """Return the ordinate of each point of a document's curves by its path: `springs.foam.loading.28 mm`."""
    return dict(_points(document, ""))


def _points(given: object, path: str) -> Iterator[tuple[str, str]]:
    if curve := _curve(given):
        yield from ((joined(path, point[0].text), point[1].text) for point in curve if len(point) == 2)
    elif not isinstance(given, Number):
        for key, entry in _entries(given):
            yield from _points(entry, joined(path, key))


def _walk(given: object, path: str) -> Iterator[ListedParameter]:
    if isinstance(given, Number):
        yield ListedParameter(path, given.text, given.source, given.confidence)
    elif isinstance(given, Sourced) and given.source is not None and given.confidence is not None:
        for key, line in given.lines().items():
            yield ListedParameter(joined(path, key), line, given.source, given.confidence)
    elif curve := _curve(given):
        first, last = curve[0], curve[-1]
        ends = " to ".join(f"({', '.join(n.text for n in point)})" for point in (first, last))
        yield ListedParameter(path, f"{len(curve)} points from {ends}", first[0].source, first[0].confidence)
    else:
        for key, entry in _entries(given):
            yield from _walk(entry, joined(path, key))


def _entries(given: object) -> Iterator[tuple[str, object]]:
    """Yield what a part of a document holds, by the words it is found under; nothing for plain values."""
    if isinstance(given, BaseModel):
        for name, info in type(given).model_fields.items():
            key, entry = info.alias or words(name), getattr(given, name)
            axes = axes_of(info.metadata)
            if axes and entry is not None:
                yield from ((f"{key}.{axis}", number) for axis, number in zip(axes, entry, strict=True))
            else:
                yield key, entry
    elif isinstance(given, dict):
        for key, entry in given.items():
            yield str(key), entry
    elif isinstance(given, (list, tuple)):
        for index, entry in enumerate(given, 1):
            yield word_of(entry, index), entry


def _curve(given: object) -> list[tuple[Number, ...]]:
    """Return the points of a curve, which is one parameter, not two a point; empty for anything else."""
    if not isinstance(given, list) or not given:
        return []
    points = [entry for entry in given if isinstance(entry, tuple) and entry]
    whole = len(points) == len(given) and all(isinstance(n, Number) for point in points for n in point)
    return points if whole else []


def word_of(entry: object, number: int) -> str:
    """Return the word that an entry of a list is found under: its id or quantity, else its number, from 1."""
    return str(getattr(entry, "id", None) or getattr(entry, "quantity", number))


def joined(path: str, key: str) -> str:
    """Return the path of what stands at a path under a key."""
    return ".".join(part for part in (path, key) if part)
