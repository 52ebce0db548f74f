"""What all definition documents share: words as keys, no unknown keys, and inherited origins.

Files of many fields have no `from __future__ import annotations`: it makes texts of annotations, and pydantic
would compile each of them again, in every process.
"""

from functools import lru_cache
from typing import Annotated, Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from certkit.definitions.loading.faults import Faults
from certkit.definitions.loading.field_types import FieldType, fields
from certkit.definitions.provenance import MIN_SOURCE, Confidence, Number, Origin, readable


@lru_cache(maxsize=1024)
def words(name: str) -> str:
    """Return the key that stands in YAML for a field's name: `added_mass` is written `added mass`."""
    return name.rstrip("_").replace("_", " ")


class Document(BaseModel):
    """A mapping in a YAML file. Keys are words such as `added mass`; unknown keys are errors."""

    model_config = ConfigDict(
        extra="forbid",
        defer_build=True,  # a section is built with the document that holds it, not once for itself
        frozen=True,
        alias_generator=words,
        populate_by_name=True,
        serialize_by_alias=True,
        coerce_numbers_to_str=True,  # `annex: 6` and `edition: 01` are words, kept as they were written
    )

    origin_keys: ClassVar[frozenset[str]] = frozenset({"origin"})
    """Keys that what is inside takes its origin from."""


class Section(Document):
    """A part of a document whose `origin` covers all bare numbers in it, and in the sections inside it."""

    origin: Origin | None = None

    @model_validator(mode="before")
    @classmethod
    def _inherit(cls, data: Any) -> Any:  # noqa: ANN401  # raw YAML data
        if not isinstance(data, dict) or "origin" not in data:
            return data
        origin = data["origin"]
        if isinstance(origin, Origin):
            origin = origin.model_dump()
        if not isinstance(origin, dict):
            return data  # reported where it stands
        shapes = {**fields(cls), "origin": None}
        origin = readable(origin)
        return {
            key: _with_origin(value, shapes.get(words(key), shapes.get(key)), origin)
            for key, value in data.items()
        }

    def numbers(self) -> dict[str, float]:
        """Return the single numbers that it gives, SI, by the names that a force law has for them too."""
        given = {name: getattr(self, name) for name in type(self).model_fields}
        return {name: float(value) for name, value in given.items() if isinstance(value, Number)}


class Sourced(Section):
    """A part whose numbers are texts with one origin: its own `source` and `confidence`, or inherited."""

    source: Annotated[str | None, Field(min_length=MIN_SOURCE)] = None
    confidence: Confidence | None = None

    @model_validator(mode="before")
    @classmethod
    def _take_origin(cls, data: Any) -> Any:  # noqa: ANN401  # raw YAML data
        origin = data.get("origin") if isinstance(data, dict) else None
        if isinstance(origin, Origin):
            origin = origin.model_dump()
        return {**readable(origin), **data} if isinstance(origin, dict) else data

    @model_validator(mode="after")
    def _has_origin(self) -> Self:
        if self.source is None or self.confidence is None:
            missing = "source" if self.source is None else "confidence"
            hint = "add it here, or an `origin` with source and confidence further up"
            raise Faults([((), f"`{missing}` is missing; {hint}")])
        return self

    def lines(self) -> dict[str, str]:
        """Return its numbers as people read them, by key; an empty key stands for the part as a whole."""
        raise NotImplementedError


def _with_origin(given: Any, shape: FieldType | None, origin: dict[str, Any]) -> Any:  # noqa: ANN401  # raw YAML data
    """Give `origin` to every number and section in `given` that has none of its own."""
    if shape is None:
        return given
    if shape.kind == "number":
        return _number_with_origin(given, origin)
    if shape.model is not None:
        inherits = issubclass(shape.model, Section) and isinstance(given, dict) and "origin" not in given
        return {"origin": origin, **given} if inherits else given
    if shape.kind == "mapping" and isinstance(given, dict):
        return {key: _with_origin(value, shape.item, origin) for key, value in given.items()}
    if shape.kind == "list" and isinstance(given, (list, tuple)):
        return [_with_origin(value, shape.item, origin) for value in given]
    return given


def _number_with_origin(given: Any, origin: dict[str, Any]) -> Any:  # noqa: ANN401  # raw YAML data
    if isinstance(given, dict):
        return {**origin, **given} if "value" in given else given
    bare = isinstance(given, (str, int, float)) and not isinstance(given, (bool, Number))
    return {"value": given, **origin} if bare else given
