"""Where the points of a face stand after its group has moved: as the solver's strips do.

Between the outlines that are known points stand between theirs, beyond the last they move with the group. On
the way back from the largest displacement L to the displacement d, what the recorded run added at that share
d/L is added, in the measure of how far in the way back begins: see
`certkit.mechanics.force_laws.recorded_path`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from certkit.documents.extraction import GroupResult

    Points = NDArray[np.float64]


def outline_at(group: GroupResult, moved: float, largest: float) -> list[tuple[float, float]]:
    """Return a face's points (x, z) in m.

    Parameters
    ----------
    group : GroupResult
        With outlines.
    moved, largest : float
        The group's displacement now, and the largest so far, m.
    """
    at = [line.at for line in group.outlines]
    end, last = at[-1], np.array(group.outlines[-1].points)
    largest = max(largest, 0.0)
    points = _between(at, [_shifted(np.array(line.points), -line.at) for line in group.outlines], largest)
    way = [line for line in group.springing_back if line.at < 1.0]
    if way and largest > 0.0:
        added = [_shifted(np.array(line.points) - last, (1.0 - line.at) * end) for line in way]
        weight = min(largest / end, 1.0) if end > 0.0 else 1.0
        shares = [*(line.at for line in way), 1.0]
        points += weight * _between(shares, [*added, np.zeros_like(last)], moved / largest)
    return [(float(x), float(z)) for x, z in _shifted(points, moved)]


def _shifted(points: Points, x: float) -> Points:
    shift: Points = np.array([x, 0.0])
    return points + shift


def _between(at: Sequence[float], lines: Sequence[Points], place: float) -> Points:
    """Return the points at a place between lines that are known, shape (n, 2); held beyond the ends."""
    where = float(np.interp(place, at, np.arange(len(lines))))
    low = int(where)
    high = min(low + 1, len(lines) - 1)
    share = where - low
    between: Points = (1.0 - share) * lines[low] + share * lines[high]
    return between
