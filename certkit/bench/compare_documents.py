"""Two results field by field: what differs beyond the seven digits that documents keep."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from pydantic import BaseModel

if TYPE_CHECKING:
    from collections.abc import Iterator

SAME = 1e-5
"""Relative difference of numbers that count as the same, of the largest of their list where there is one."""


class Difference(Struct, frozen=True):
    """One field that differs: where it is, and both values in words."""

    place: str
    said: str
    made: str


def differences(said: object, made: object, place: str = "", *, scale: float = 0.0) -> Iterator[Difference]:
    """Yield the differences of two parts of documents, in the order of their fields.

    Numbers are the same within `SAME` of their own size or of `scale`: of a criterion that is the size of its
    value and limits, whose difference the margin is; of a list its largest number.
    """
    if isinstance(said, BaseModel) and isinstance(made, BaseModel):
        size = _size(said)
        for name in type(said).model_fields:
            inner = 100.0 if name.endswith("percent") else size
            yield from differences(getattr(said, name), getattr(made, name), _inner(place, name), scale=inner)
    elif isinstance(said, dict) and isinstance(made, dict):
        for key in dict.fromkeys((*said, *made)):
            yield from differences(said.get(key), made.get(key), _inner(place, str(key)))
    elif isinstance(said, list | tuple) and isinstance(made, list | tuple):
        yield from _lists(said, made, place)
    elif _is_number(said) and _is_number(made):
        if not math.isclose(said, made, rel_tol=SAME, abs_tol=SAME * scale + 1e-12):  # type: ignore[arg-type]  # numbers
            yield Difference(place, f"{said:.7g}", f"{made:.7g}")
    elif said != made:
        yield Difference(place, _shown(said), _shown(made))


def _size(part: BaseModel) -> float:
    """Return the size of what a part is about, where it has a value and limits."""
    fields = ("value", "lower", "upper") if "margin" in type(part).model_fields else ()
    return max((abs(value) for name in fields if _is_number(value := getattr(part, name))), default=0.0)


def _lists(said: Any, made: Any, place: str) -> Iterator[Difference]:  # noqa: ANN401  # lists of any kind
    if len(said) != len(made):
        yield Difference(place, f"{len(said)} entries", f"{len(made)} entries")
    elif said and _are_numbers(said) and _are_numbers(made):
        yield from _columns([said], [made], place)
    elif said and all(map(_are_numbers, (*said, *made))) and len({len(row) for row in (*said, *made)}) == 1:
        yield from _columns(zip(*said, strict=True), zip(*made, strict=True), place)
    else:
        for index, (before, after) in enumerate(zip(said, made, strict=True)):
            name = str(getattr(before, "id", "") or index)
            yield from differences(before, after, _inner(place, name))


def _columns(said: Any, made: Any, place: str) -> Iterator[Difference]:  # noqa: ANN401  # rows of numbers
    """Compare columns of numbers; of each the first difference is told."""
    for before, after in zip(said, made, strict=True):
        bound = SAME * max(map(abs, after)) + 1e-12
        for index, (old, new) in enumerate(zip(before, after, strict=True)):
            if abs(old - new) > bound:
                yield Difference(_inner(place, str(index)), f"{old:.7g}", f"{new:.7g}")
                break


def _are_numbers(values: object) -> bool:
    return isinstance(values, list | tuple) and bool(values) and all(map(_is_number, values))


def _inner(place: str, name: str) -> str:
    return f"{place}.{name}" if place else name


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _shown(value: object) -> str:
    text = " ".join(str(value).split())
    return "nothing" if value in (None, "") else text if len(text) <= 120 else f"{text[:117]}…"
