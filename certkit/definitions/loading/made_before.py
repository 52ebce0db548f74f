"""Parts of a definition that were made before: of a changed file, only what has changed is read again.

Trees are never changed and share what is alike, so that a part is unchanged where it is the same object. Its
section or number then stands in the tree in place of its plain data, and pydantic takes it as it is; checks
between sections see the whole document as ever.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from certkit.definitions.base import Document, words
from certkit.definitions.provenance import Number

if TYPE_CHECKING:
    from certkit.definitions.loading.search_path import Found

_MOST_KEPT = 64

Parts = dict[tuple[int, int], Any]
"""What stands for unchanged plain data, by the identities of that data and of what was made of it."""

_MADE: dict[tuple[str, Found], tuple[dict[str, Any], BaseModel, Parts]] = {}


def keep(
    kind: str, found: Found, data: dict[str, Any], document: BaseModel, *, changed: bool = False
) -> None:
    """Remember what was made of a file, and of which data: best of the file as it stands."""
    if changed and (kind, found) in _MADE:
        return
    if len(_MADE) >= _MOST_KEPT:
        _MADE.clear()
    _MADE[kind, found] = data, document, {}


def with_made(kind: str, found: Found, data: dict[str, Any]) -> Any:  # noqa: ANN401  # data or a document
    """Return a file's data with whatever was made of it before, None for nothing; see `parts_made`."""
    kept = _MADE.get((kind, found))
    return None if kept is None else parts_made(data, *kept)


def parts_made(data: Any, before: Any, made: Any, parts: Parts) -> Any:  # noqa: ANN401  # raw YAML data
    """Return data in which unchanged parts stand as they were made.

    Parameters
    ----------
    data, before : any
        Plain data now and then; what is unchanged is the same object in both.
    made : any
        What was made of `before`.
    parts : Parts
        Filled with what unchanged data come to.
    """
    if data is before and isinstance(made, (Document, Number)):
        return made
    if data is not before or not isinstance(data, (dict, list)):
        return _with_parts(data, before, made, parts)
    key = (id(before), id(made))
    if key not in parts:
        parts[key] = _with_parts(data, before, made, parts)
    return parts[key]


def _with_parts(data: Any, before: Any, made: Any, parts: Parts) -> Any:  # noqa: ANN401  # raw YAML data
    if isinstance(data, dict) and isinstance(before, dict):
        raw: frozenset[str] = frozenset()
        if isinstance(made, Document):
            # Where origins come from has to be seen, and what inherits another one is another part.
            raw = made.origin_keys
            if any(data.get(key) is not before.get(key) for key in raw):
                return data
        return {
            key: value if key in raw else parts_made(value, before.get(key), _under(made, key), parts)
            for key, value in data.items()
        }
    lists = isinstance(data, list) and isinstance(before, list) and isinstance(made, (list, tuple))
    if lists and len(data) == len(before) == len(made):
        return [parts_made(*each, parts) for each in zip(data, before, made, strict=True)]
    return data


def _under(made: Any, key: str) -> Any:  # noqa: ANN401  # any part of a document
    if isinstance(made, BaseModel):
        return getattr(made, _names(type(made)).get(key, ""), None)
    return made.get(key) if isinstance(made, dict) else None


@cache
def _names(model: type[BaseModel]) -> dict[str, str]:
    return {words(name): name for name in model.model_fields}
