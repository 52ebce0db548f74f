"""How a group of an extraction case names its parts beside their names: by boxes in space and by ids."""

from __future__ import annotations

import re
from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from certkit.definitions.base import Section
from certkit.definitions.loading.faults import Fault, Faults
from certkit.definitions.provenance import Length  # pydantic reads annotations

_ID_RANGE = re.compile(r"(\d+)(?:\s*[-–]\s*(\d+))?")
AXES = ("x", "y", "z")


def _id_range(text: str) -> str:
    found = _ID_RANGE.fullmatch(text.strip())
    if found is None:
        raise ValueError(f"`{text}` is no id and no range of ids; write 2005 or 1000-1999")
    if found[2] is not None and int(found[2]) < int(found[1]):
        raise ValueError(f"the range `{text}` ends before it begins; write {found[2]}-{found[1]}")
    return text


IdRange = Annotated[str, AfterValidator(_id_range)]
"""An id, `2005`, or a range of ids, `1000-1999`, both ends included."""


def ids_of(text: str) -> range:
    """Return the ids of an id or a range."""
    found = _ID_RANGE.fullmatch(text.strip())
    if found is None:
        raise ValueError(f"`{text}` is no range of ids")
    return range(int(found[1]), int(found[2] or found[1]) + 1)


class Box(Section):
    """A box in the axes of the finite-element model; an axis that is not named is not bounded."""

    x: Annotated[list[Length] | None, Field(description="From and to, such as `[700 mm, 820 mm]`.")] = None
    y: list[Length] | None = None
    z: list[Length] | None = None

    @property
    def bounds(self) -> dict[str, tuple[float, float]]:
        """Return from and to by axis, m."""
        given = {axis: getattr(self, axis) for axis in AXES}
        return {axis: (float(ends[0]), float(ends[1])) for axis, ends in given.items() if ends is not None}

    def holds(self, place: tuple[float | None, float | None, float | None]) -> bool:
        """Tell whether a place lies in it; a coordinate that is not known lies in no bounds."""
        at = dict(zip(AXES, place, strict=True))
        return all(
            (value := at[axis]) is not None and low <= value <= high
            for axis, (low, high) in self.bounds.items()
        )

    @model_validator(mode="after")
    def _bounded(self) -> Self:
        faults: list[Fault] = []
        for axis in AXES:
            ends = getattr(self, axis)
            if ends is not None and len(ends) != 2:
                faults.append(
                    ((axis,), f"has {len(ends)} entries; write from and to: {axis}: [0 mm, 100 mm]")
                )
            elif ends is not None and not float(ends[0]) < float(ends[1]):
                faults.append(
                    ((axis,), f"`{ends[1].text}` does not lie beyond `{ends[0].text}`; write from and to")
                )
        if not faults and not self.bounds:
            faults.append(((), "a box needs bounds along x, y or z, such as x: [0 mm, 100 mm]"))
        if faults:
            raise Faults(faults)
        return self
