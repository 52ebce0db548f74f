"""The rigid segments of a leg; their masses meet each part's mass, centre of gravity and inertia."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.definitions.legform import KNEE, WHOLE
from certkit.errors import RunError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.legform import Legform
    from certkit.definitions.legform_parts import Bone, Knee


class Segment(Struct, frozen=True):
    """A rigid piece of the leg; heights in m above the knee centre.

    Parameters
    ----------
    part : str
        The part of the legform that it belongs to: `knee`, or such as `femur`.
    top, bottom, centre : float
        Its ends and its centre of gravity.
    mass, inertia : float
        Inertia about its own centre of gravity.
    depth : float
        Outer size along the impact.
    """

    part: str
    top: float
    bottom: float
    centre: float
    mass: float
    inertia: float
    depth: float

    @property
    def is_knee(self) -> bool:
        """Whether it is a block of the knee."""
        return self.part == KNEE

    @property
    def length(self) -> float:
        """Return the height of the segment."""
        return self.top - self.bottom

    def with_mass(self, mass: float, height: float, own_inertia: float = 0.0) -> Segment:
        """Return the segment with a mass fixed to it, with an inertia about its own centre of gravity."""
        both = self.mass + mass
        centre = (self.mass * self.centre + mass * height) / both
        inertia = self.inertia + self.mass * (self.centre - centre) ** 2 + mass * (height - centre) ** 2
        inertia += own_inertia
        return replace(self, mass=both, centre=centre, inertia=inertia)


def assembled(segments: Sequence[Segment]) -> tuple[float, float, float]:
    """Return mass, height of the centre of gravity and inertia about it of segments held rigidly together."""
    mass = sum(s.mass for s in segments)
    centre = sum(s.mass * s.centre for s in segments) / mass
    return mass, centre, sum(s.inertia + s.mass * (s.centre - centre) ** 2 for s in segments)


def bone_segments(part: str, bone: Bone, top: float) -> list[Segment]:
    """Cut a bone into equal segments, from the top.

    A uniform bar of the bone's length and depth carries most of the mass; what its fittings add sits at
    both ends. The three masses follow from the bone's mass, centre of gravity and inertia.

    Raises
    ------
    RunError
        When no distribution without negative masses meets the three.
    """
    length, depth, centre = float(bone.length), float(bone.depth), float(bone.centre_of_gravity)
    bar = (length**2 + depth**2) / 12 + (length / 2 - centre) ** 2
    matrix = np.array([[1.0, 1.0, 1.0], [length / 2, 0.0, length], [bar, centre**2, (length - centre) ** 2]])
    wanted = np.array([1.0, centre, float(bone.inertia) / float(bone.mass)]) * float(bone.mass)
    spread, upper, lower = (float(m) for m in np.linalg.solve(matrix, wanted))
    if min(spread, upper, lower) < 0:
        raise RunError(
            f"no distribution of the {part}'s mass meets its centre of gravity and inertia "
            f"(bar {spread:.3f} kg, ends {upper:.3f} and {lower:.3f} kg): {bone.spread_fault()}"
        )
    n = bone.segments
    height, mass = length / n, spread / n
    segments = [
        Segment(
            part,
            top - i * height,
            top - (i + 1) * height,
            top - (i + 0.5) * height,
            mass,
            mass * (height**2 + depth**2) / 12,
            depth,
        )
        for i in range(n)
    ]
    segments[0] = segments[0].with_mass(upper, top)
    segments[-1] = segments[-1].with_mass(lower, top - length)
    return segments


def knee_blocks(knee: Knee) -> list[Segment]:
    """Return the two blocks of the knee, the femur block first.

    Each has its centre of gravity at half its height; the knee's centre of gravity shares out the mass, and
    what its inertia needs beyond that goes to both in proportion to their masses.

    Raises
    ------
    RunError
        When that would need a negative mass or inertia.
    """
    above, below = float(knee.above_centre), float(knee.below_centre)
    mass, centre = float(knee.mass), above - float(knee.centre_of_gravity)
    lower = mass * (above / 2 - centre) / ((above + below) / 2)
    upper = mass - lower
    left = float(knee.inertia) - upper * (above / 2 - centre) ** 2 - lower * (below / 2 + centre) ** 2
    if min(upper, lower, left) <= 0:
        raise RunError(
            "no two blocks meet the knee's mass, centre of gravity and inertia; check them in the legform"
        )
    return [
        Segment(KNEE, above, 0.0, above / 2, upper, left * upper / mass, float(knee.depth)),
        Segment(KNEE, 0.0, -below, -below / 2, lower, left * lower / mass, float(knee.depth)),
    ]


def leg_segments(legform: Legform, part: str = WHOLE) -> list[Segment]:
    """Return the segments of a leg, or of one of its parts, from top to bottom."""
    names = legform.chain if part == WHOLE else (part,)
    return [
        segment
        for name in names
        for segment in (
            knee_blocks(legform.knee)
            if name == KNEE
            else bone_segments(name, legform.parts[name], legform.span(name)[0])
        )
    ]
