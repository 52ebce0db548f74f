"""Where the points of a face stand after its group has moved, between the outlines that are known."""

from __future__ import annotations

from bisect import bisect_right
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import GroupResult, OutlineResult


def outline_at(group: GroupResult, history: Sequence[float]) -> list[tuple[float, float]]:
    """Return a face's points (x, z) in m after a history of its group's displacement, m."""
    largest = max(max(history, default=0.0), 0.0)
    points = _between(group.outlines, largest)
    if group.springing_back and largest > 0:
        last = group.outlines[-1].points
        returning = [*group.springing_back]
        share = history[-1] / largest
        back = _between(returning, share) if share <= returning[-1].at else last
        if share > returning[-1].at:
            weight = (1 - share) / (1 - returning[-1].at) if returning[-1].at < 1 else 0.0
            back = tuple(
                ((1 - weight) * a + weight * c, (1 - weight) * b + weight * d)
                for (a, b), (c, d) in zip(last, returning[-1].points, strict=True)
            )
        scale = largest - group.outlines[-1].at
        points = tuple(
            (x + bx - lx + scale * (share - 1), z + bz - lz)
            for (x, z), (bx, bz), (lx, lz) in zip(points, back, last, strict=True)
        )
    return list(points)


def _between(lines: Sequence[OutlineResult], at: float) -> tuple[tuple[float, float], ...]:
    """Return the outline between two that are known; the last is carried on by the displacement."""
    places = [line.at for line in lines]
    k = bisect_right(places, at)
    if k == 0:
        return lines[0].points
    if k == len(lines):
        return tuple((x + at - places[-1], z) for x, z in lines[-1].points)
    share = (at - places[k - 1]) / (places[k] - places[k - 1])
    return tuple(
        ((1 - share) * a + share * c, (1 - share) * b + share * d)
        for (a, b), (c, d) in zip(lines[k - 1].points, lines[k].points, strict=True)
    )
