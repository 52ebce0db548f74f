"""Numbers of a definition that somebody has confirmed: they carry the text that was read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from pydantic import BaseModel

from certkit.definitions.base import Sourced, words
from certkit.definitions.loading.field_types import axes_of
from certkit.definitions.loading.parameter_list import joined, parameters, word_of
from certkit.definitions.provenance import Number

if TYPE_CHECKING:
    from certkit.definitions.confirmation import Confirmation

D = TypeVar("D", bound=BaseModel)


def confirmation_name(kind: str, name: str) -> str:
    """Return what the confirmation of a definition is called."""
    return f"{kind}-{name}"


def with_confirmation(document: D, confirmation: Confirmation) -> tuple[D, list[str]]:
    """Give confirmed numbers the source that they were confirmed by.

    Returns
    -------
    document : BaseModel
        With `verified` where a number is the one that was confirmed.
    lost : list of str
        A sentence for each number that was changed since, or is there no more: it is confirmed no longer.
    """
    today = {entry.path: entry.value for entry in parameters(document)}
    sources, lost = {}, []
    for path, number in confirmation.numbers.items():
        if number.answer != "yes":
            continue
        if today.get(path) == number.value:
            sources[path] = confirmation.source(number)
        else:
            now = f"is `{today[path]}` now" if path in today else "is there no more"
            lost.append(f"`{path}` was confirmed as `{number.value}` and {now}: it is confirmed no longer")
    return _confirmed(document, "", sources), lost


def _confirmed(given: Any, path: str, sources: dict[str, str]) -> Any:  # noqa: ANN401  # any part of a document
    """Return a part of a document with the origins of its confirmed numbers; paths are `parameters`' own."""
    if isinstance(given, Number):
        found: Any = _sourced(given, sources[path]) if path in sources else given
    elif isinstance(given, Sourced) and given.source is not None and given.confidence is not None:
        found = _confirmed_lines(given, path, sources)
    elif isinstance(given, BaseModel):
        found = _confirmed_fields(given, path, sources)
    elif isinstance(given, dict):
        found = {key: _confirmed(entry, joined(path, str(key)), sources) for key, entry in given.items()}
    elif isinstance(given, (list, tuple)):
        found = _confirmed_list(given, path, sources)
    else:
        found = given
    return found


def _confirmed_lines(given: Sourced, path: str, sources: dict[str, str]) -> Sourced:
    """Return a corridor, limit or rule as confirmed when all of its numbers are."""
    found = [sources.get(joined(path, key)) for key in given.lines()]
    whole = [source for source in found if source is not None]
    if not found or len(whole) < len(found):
        return given
    return given.model_copy(update={"source": "; ".join(dict.fromkeys(whole)), "confidence": "verified"})


def _confirmed_list(
    given: list[Any] | tuple[Any, ...], path: str, sources: dict[str, str]
) -> list[Any] | tuple[Any, ...]:
    if path in sources:  # a curve is one number of the list
        return type(given)(tuple(_sourced(n, sources[path]) for n in point) for point in given)
    return type(given)(
        _confirmed(entry, joined(path, word_of(entry, number)), sources)
        for number, entry in enumerate(given, 1)
    )


def _confirmed_fields(given: BaseModel, path: str, sources: dict[str, str]) -> BaseModel:
    changed = {}
    for name, info in type(given).model_fields.items():
        entry, place = getattr(given, name), joined(path, info.alias or words(name))
        axes = axes_of(info.metadata)
        if axes and entry is not None:
            parts = zip(axes, entry, strict=True)
            new: Any = type(entry)(_confirmed(part, f"{place}.{axis}", sources) for axis, part in parts)
        else:
            new = _confirmed(entry, place, sources)
        if new is not entry:
            changed[name] = new
    return given.model_copy(update=changed) if changed else given


def _sourced(number: Number, source: str) -> Number:
    return Number(float(number), number.text, source, "verified")
