"""What fixtures are built into: the world so far, the leg in it, what they add for channels and picture."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform
    from certkit.definitions.rig import Rig
    from certkit.mechanics.leg import Leg
    from certkit.mechanics.rigs.front import Strip
    from certkit.mechanics.world import Assembly

GRAVITY = 9.81
STRIP = 0.004
"""Obstacles are cut into strips of at most this height, m."""

Outline = tuple[tuple[float, float], ...]


@dataclass
class Site:
    """A rig under construction.

    Parameters
    ----------
    assembly, legform, rig, leg
        The world being assembled, and what it is assembled from.
    cover : float
        Thickness of the flesh between bone and obstacle, 0 where it is not fitted.
    trigger : int
        Law whose force marks first contact; -1 where the run starts in contact.
    longest : float
        Seconds after which a run without contact is given up.
    reach : float
        Massless rigid ends beyond the specimen, on which supports may stand.
    figures : dict of int to outlines
        Of moving bodies of the rig: polygons in the body's frame, for the picture.
    scene : list
        Names and polygons of what never moves.
    front : dict of str to int
        Bodies of a vehicle's groups.
    strips, springs : tuple
        Strips of its faces and names of its springs, in the order of their rows.
    """

    assembly: Assembly
    legform: Legform
    rig: Rig
    leg: Leg
    cover: float
    trigger: int = -1
    longest: float = 0.0
    reach: float = 0.0
    figures: dict[int, tuple[str, Outline]] = field(default_factory=dict)
    scene: list[tuple[str, Outline]] = field(default_factory=list)
    front: dict[str, int] = field(default_factory=dict)
    strips: tuple[Strip, ...] = ()
    springs: tuple[str, ...] = ()

    def end_height(self, end: str) -> float:
        """Return the height of `femur end` or `tibia end`."""
        return self.leg.top if end == "femur end" else self.leg.bottom

    def end_body(self, end: str) -> int:
        """Return the body at `femur end` or `tibia end`."""
        return self.leg.bodies[0 if end == "femur end" else -1]

    def beyond(self, end: str, offset: float) -> float:
        """Return the height of a point beyond an end by `offset`."""
        return self.end_height(end) + (offset if end == "femur end" else -offset)

    def face(self, top: float, bottom: float) -> float:
        """Return how far the upright leg, flesh included, stands out between two heights."""
        depths = [s.depth for s in self.leg.segments if s.bottom < top and s.top > bottom]
        return max(depths, default=0.0) / 2 + self.cover

    def draw_outline(self) -> None:
        """Tell the world what of the leg obstacles meet: call it when all fixtures stand."""
        ram = self.rig.ram
        last = len(self.leg.segments) - 1
        for i, (segment, body) in enumerate(zip(self.leg.segments, self.leg.bodies, strict=True)):
            width = 0.0
            if ram is not None:
                width = ram.width_on_knee if segment.part == "knee" else ram.width_on_bones
            self.assembly.add_outline(
                body,
                segment.top - segment.centre + (self.reach if i == 0 else 0.0),
                segment.bottom - segment.centre - (self.reach if i == last else 0.0),
                segment.depth / 2,
                width,
            )


def strips(top: float, height: float) -> list[tuple[float, float]]:
    """Cut a band into strips: middle and height of each, from the top."""
    n = max(1, math.ceil(height / STRIP - 1e-9))
    return [(top - (i + 0.5) * height / n, height / n) for i in range(n)]


def box(left: float, right: float, bottom: float, top: float) -> Outline:
    """Return a rectangle as a polygon."""
    return ((left, bottom), (right, bottom), (right, top), (left, top))


def disc(x: float, z: float, radius: float) -> Outline:
    """Return a circle as a polygon."""
    return tuple(
        (x + radius * math.cos(k * math.pi / 12), z + radius * math.sin(k * math.pi / 12)) for k in range(24)
    )
