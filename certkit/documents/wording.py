"""Words of a document's reasons: filled in from their codes, and left out of the id.

A part of a document has its reasons in fields `coded_NAME`; the field NAME beside holds their words, for
whoever reads the file. Codes without a twin are worded as well. Words without a code are left as they are:
they belong to the content, and documents that an earlier certkit wrote have no codes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

from pydantic import BaseModel

from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

CODED = "coded_"
"""Begins the name of a field whose words stand in the field of the same name without it."""

Model = TypeVar("Model", bound=BaseModel)


def with_words(part: Model, words: Callable[[Reason], str]) -> Model:
    """Return a document, or a part of one, with its reasons worded.

    Parameters
    ----------
    part : Model
        Lists of numbers are passed over, so that it costs next to nothing.
    words : callable
        The words of a reason, in some language.
    """
    changes: dict[str, Any] = {}
    for name in type(part).model_fields:
        value = getattr(part, name)
        if not isinstance(value, BaseModel | list | tuple | dict) or not value:
            continue
        changed = _worded(value, words)
        if changed is not value:
            changes[name] = changed
        if name.startswith(CODED):
            changes[name.removeprefix(CODED)] = _texts(changed)
    return part.model_copy(update=changes) if changes else part


def without_words(part: Model) -> Model:
    """Return a document whose coded reasons have no words, as its id counts it."""
    return with_words(part, lambda _: "")


def _worded(value: Any, words: Callable[[Reason], str]) -> Any:  # noqa: ANN401  # any field of a document
    """Word what holds reasons; return the very same object where nothing changes."""
    if isinstance(value, Reason):
        return value.worded(words(value))
    if isinstance(value, BaseModel):
        return with_words(value, words)
    items = list(value.values()) if isinstance(value, dict) else value
    if not isinstance(items[0], BaseModel):
        return value
    changed = [_worded(item, words) for item in items]
    if all(new is old for new, old in zip(changed, items, strict=True)):
        return value
    if isinstance(value, dict):
        return dict(zip(value, changed, strict=True))
    return type(value)(changed)  # a tuple stays one, and so does a list whose parts are found by id


def _texts(coded: Reason | Sequence[Reason]) -> str | list[str]:
    """Return the words of one reason, or of a list of them; none where they have no words."""
    if isinstance(coded, Reason):
        return coded.text
    return [reason.text for reason in coded if reason.text]
