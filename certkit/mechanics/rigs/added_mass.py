"""A mass fixed to one end of the leg."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.rig import AddedMass
    from certkit.mechanics.segments import Segment


def with_added_mass(segments: Sequence[Segment], added: AddedMass) -> list[Segment]:
    """Return the leg's segments with the mass on the end segment."""
    at, height = (
        (0, segments[0].top + added.offset)
        if added.at == "femur end"
        else (len(segments) - 1, segments[-1].bottom - added.offset)
    )
    return [s.with_mass(float(added.mass), height) if i == at else s for i, s in enumerate(segments)]
