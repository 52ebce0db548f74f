"""What a field of a document holds, read from its annotation: a number, a document, or many of either.

Origins are inherited, paths are found and numbers are listed along this one description.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from typing import Any, Literal, get_args, get_origin

from msgspec import Struct
from pydantic import BaseModel

from certkit.definitions.provenance import QuantityDimension


class FieldType(Struct, frozen=True):
    """What stands under a key.

    Parameters
    ----------
    kind : {'number', 'document', 'mapping', 'list', 'plain'}
        `mapping` and `list` hold many of `item`; `plain` is a word, a count or a choice.
    model : type, optional
        The document's class.
    dimension : str
        The number's dimension, a key of `certkit.definitions.units.UNITS`.
    item : FieldType, optional
        What each entry of a mapping or list holds.
    axes : tuple of str
        Names of a point's coordinates, in their order in the list; empty for any other list.
    """

    kind: Literal["number", "document", "mapping", "list", "plain"]
    model: type[BaseModel] | None = None
    dimension: str = ""
    item: FieldType | None = None
    axes: tuple[str, ...] = ()


class Axes(Struct, frozen=True):
    """Marks a list of numbers as a point in space: its coordinates have names."""

    names: tuple[str, ...]


PLAIN = FieldType("plain")


def shape_of(annotation: Any, metadata: Iterable[Any] = ()) -> FieldType:  # noqa: ANN401  # any annotation
    """Return the shape behind an annotation; `None` beside another type is left out of account."""
    metadata = tuple(metadata)
    for mark in metadata:
        if isinstance(mark, QuantityDimension):
            return FieldType("number", dimension=mark.name)
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return FieldType("document", model=annotation)
    container, arguments = get_origin(annotation), get_args(annotation)
    if hasattr(annotation, "__metadata__"):
        return shape_of(annotation.__origin__, annotation.__metadata__)
    if container in {dict, Mapping}:
        return FieldType("mapping", item=shape_of(arguments[1]))
    if container in {list, tuple}:
        shapes = [shape_of(a) for a in arguments if a is not Ellipsis]
        return FieldType(
            "list", item=next((s for s in shapes if s.kind != "plain"), PLAIN), axes=axes_of(metadata)
        )
    return next((s for s in map(shape_of, arguments) if s.kind != "plain"), PLAIN)


def axes_of(metadata: Iterable[Any]) -> tuple[str, ...]:
    """Return the names of the coordinates of a point, empty for anything else."""
    return next((mark.names for mark in metadata if isinstance(mark, Axes)), ())


@cache
def fields(model: type[BaseModel]) -> dict[str, FieldType]:
    """Return the keys that a document knows, as they are written, and what each holds."""
    return {
        info.alias or name: shape_of(info.annotation, info.metadata)
        for name, info in model.model_fields.items()
    }
