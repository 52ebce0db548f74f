"""Where the groups of a front stand in a sketch of its load paths: in height to scale, across by order."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting.number_format import shortened

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult
    from certkit.reporting.scales import Scale

FACE, GROUND = 150.0, 392.0
"""px: where the faces and the ground stand."""
BOX, TALL = 34.0, 17.0
"""px: size of a group behind the faces, which grows with its name."""
LETTERS = 13
"""Of a name that are shown."""


class GroupPlace(Struct, frozen=True):
    """Middle of a group, and its left and right edge, px."""

    x: float
    z: float
    left: float
    right: float


def group_places(result: ExtractionResult, z: Scale) -> dict[str, GroupPlace]:
    """Return where groups stand: faces in front, others the farther right the later they are reached."""
    heights = _heights(result)
    faces = {g.name for g in result.groups if g.position is not None}
    inside = [g.name for g in result.groups if g.kind != "impactor" and g.name not in faces]
    depth = dict.fromkeys(faces, 0)
    for _ in inside:
        for path in result.paths:
            if path.source in depth and path.target in inside and path.target != path.source:
                depth[path.target] = min(
                    max(depth.get(path.target, 0), depth[path.source] + 1), max(len(inside), 1)
                )
    deepest = max((depth.get(name, 1) for name in inside), default=1)
    step = (GROUND - FACE - 60) / max(deepest, 1)
    places = {
        name: GroupPlace(FACE, z(heights[name]), FACE - 5, FACE + 5) for name in faces if name in heights
    }
    for column in range(1, deepest + 1):
        x = FACE + 30 + step * (column - 0.35)
        members = sorted((n for n in inside if depth.get(n, 1) == column), key=lambda n: -heights.get(n, 0.0))
        last = -1e9
        for name in members:
            if name not in heights:
                continue
            y = max(z(heights[name]), last + TALL + 4)
            last = y
            half = max(BOX, 6.3 * len(short(name)) + 8) / 2
            places[name] = GroupPlace(x, y, x - half, x + half)
    return places


def _heights(result: ExtractionResult) -> dict[str, float]:
    """Return the middle height of each group, m: of its face, of its nodes, or of what presses on it."""
    heights = {
        g.name: 0.5 * (g.low + g.high) for g in result.groups if g.low is not None and g.high is not None
    }
    for line in result.motion.lines if result.motion else ():
        if line.name not in heights and line.kind == "inside":
            first = (line.run or line.model)[0]
            heights[line.name] = sum(z for _, z in first) / len(first)
    for _ in result.groups:
        for group in result.groups:
            if group.name in heights or group.kind == "impactor":
                continue
            pressing = [
                heights[p.source] for p in result.paths if p.target == group.name and p.source in heights
            ]
            if pressing:
                heights[group.name] = sum(pressing) / len(pressing)
    return heights


def short(name: str) -> str:
    """Return a name as it fits in the sketch."""
    return shortened(name, LETTERS)
