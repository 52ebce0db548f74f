"""What all definition documents share: words instead of identifiers, no unknown keys, and inherited origins."""

from __future__ import annotations

from typing import Any, get_args

from pydantic import BaseModel, ConfigDict, model_validator

from certkit.definitions.origin import Dimension, Origin


def _words(name: str) -> str:
    return name.rstrip("_").replace("_", " ")


class Document(BaseModel):
    """A mapping in a YAML file. Keys are words: `added mass`, `bending stiffness`; unknown keys are errors."""

    model_config = ConfigDict(extra="forbid", frozen=True, alias_generator=_words, populate_by_name=True)


def _is_number(annotation: Any, metadata: list[Any]) -> bool:  # noqa: ANN401  # type annotations of any kind
    """Tell whether a field is a `Number`, also where it is optional or a list of them."""
    if any(isinstance(m, Dimension) for m in metadata):
        return True
    return any(isinstance(a, Dimension) or _is_number(a, []) for a in get_args(annotation))


def _with_origin(given: Any, origin: dict[str, Any]) -> Any:  # noqa: ANN401  # raw YAML data
    """Give `origin` to a bare number, to the bare numbers in a list, or to a number that lacks its own."""
    if isinstance(given, list):
        return [_with_origin(item, origin) for item in given]
    if isinstance(given, dict) and "value" in given:
        return {**origin, **given}
    if isinstance(given, (str, int, float)) and not isinstance(given, bool):
        return {"value": given, **origin}
    return given


class Section(Document):
    """A part of a document whose `origin` covers all bare numbers in it, and in the sections inside it."""

    origin: Origin | None = None

    @model_validator(mode="before")
    @classmethod
    def _inherit(cls, data: Any) -> Any:  # noqa: ANN401  # raw YAML data
        if not isinstance(data, dict) or not isinstance(data.get("origin"), dict):
            return data
        origin = {k: v for k, v in data["origin"].items() if k in {"source", "confidence"}}
        filled = dict(data)
        for name, info in cls.model_fields.items():
            key = info.alias or _words(name)
            if key not in filled or key == "origin":
                continue
            given = filled[key]
            if _is_number(info.annotation, list(info.metadata)):
                filled[key] = _with_origin(given, origin)
            elif isinstance(given, dict) and "origin" not in given and holds_sections(info.annotation):
                filled[key] = {"origin": origin, **given}
            elif isinstance(given, dict) and maps_sections(info.annotation):
                filled[key] = {
                    k: {"origin": origin, **v} if isinstance(v, dict) and "origin" not in v else v
                    for k, v in given.items()
                }
            elif isinstance(given, list) and maps_sections(info.annotation):
                filled[key] = [
                    {"origin": origin, **v} if isinstance(v, dict) and "origin" not in v else v for v in given
                ]
        return filled


def holds_sections(annotation: Any) -> bool:  # noqa: ANN401  # type annotations of any kind
    """Tell whether an annotation is a `Section`, or an optional one."""
    if isinstance(annotation, type):
        return issubclass(annotation, Section)
    origin = getattr(annotation, "__origin__", None)
    return origin not in {dict, list, tuple} and any(holds_sections(a) for a in get_args(annotation))


def maps_sections(annotation: Any) -> bool:  # noqa: ANN401  # type annotations of any kind
    """Tell whether an annotation is a mapping or list of `Section`s."""
    origin = getattr(annotation, "__origin__", None)
    return origin in {dict, list, tuple} and any(holds_sections(a) for a in get_args(annotation))
