"""What a vehicle's front did against what it was made for: travel of its groups, range of its springs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reasons import Reason

if TYPE_CHECKING:
    from certkit.definitions.vehicle import Vehicle
    from certkit.documents.result import Front

RANGE = 1.001
"""Times the last point of a spring's curve up to which it is within its range; rounding is no departure."""


def largest_travel(front: Front) -> float:
    """Return how far the group that moves most goes, mm; 0 for a front without groups."""
    series = front.displacement.series.values()
    return max((abs(float(value)) for one in series for value in one.values), default=0.0)


def beyond_range(front: Front, vehicle: Vehicle) -> list[Reason]:
    """Return a remark on springs that were shortened beyond the last point of their curve.

    Parameters
    ----------
    front : Front
        Force over shortening, mm, by the springs' names.
    vehicle : Vehicle
        The last point of `loading` is what a spring was extracted or measured up to.
    """
    said = []
    for name, spring in vehicle.springs.items():
        if name not in front.springs or spring.bottoming is not None:
            continue
        last = (float(spring.loading[-1][0]) + float(spring.gap or 0.0)) * 1e3
        most = max((float(point[0]) for point in front.springs[name].points), default=0.0)
        if most > RANGE * last:
            said.append(Reason.of("spring-beyond-range", spring=name, shortening=most, last=last))
    return said
