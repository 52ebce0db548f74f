"""What a vehicle's front did against what it was made for: travel of its groups, range of its springs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reasons import Reason

if TYPE_CHECKING:
    from certkit.definitions.vehicle import FrontSheet, Vehicle
    from certkit.documents.result import Front

RANGE = 1.001
"""Times what a spring's curve is known up to, within which it is in its range; rounding is no departure."""


class Use(Struct, frozen=True):
    """What a group or a spring used of what there is, in per cent; the one that used most."""

    name: str
    percent: float


class FrontUse(Struct, frozen=True):
    """How far a front went into the room and the curves that it was made with.

    Parameters
    ----------
    travel_mm : float
        Of the group without a known room that moves most; 0 where there is none.
    room : Use or None
        Largest travel over the room behind a group; None where no room is known.
    springs : Use or None
        Largest shortening over the end of the curve of an extracted spring; None where none was extracted.
    """

    travel_mm: float
    room: Use | None
    springs: Use | None


def front_use(front: Front, vehicle: Vehicle) -> FrontUse:
    """Return what a front used of its rooms and curves.

    Parameters
    ----------
    front : Front
        Displacements of the groups, mm, and force over shortening, mm, by the springs' names.
    vehicle : Vehicle
        A spring with `seen` was extracted: its curve goes on beyond that, and ends at the last point of
        `loading`. There its extraction says nothing any more.
    """
    travels = {
        name: max((abs(float(value)) for value in series.values), default=0.0)
        for name, series in front.displacement.series.items()
    }
    rooms = {n: float(g.room) * 1e3 for n, g in vehicle.groups.items() if g.room is not None and n in travels}
    ends = {
        name: (float(spring.loading[-1][0]) + float(spring.gap or 0.0)) * 1e3
        for name, spring in vehicle.springs.items()
        if spring.seen is not None and spring.bottoming is None and name in front.springs
    }
    shortenings = {
        name: max((float(point[0]) for point in front.springs[name].points), default=0.0) for name in ends
    }
    return FrontUse(
        travel_mm=max((travel for name, travel in travels.items() if name not in rooms), default=0.0),
        room=_most({name: 100.0 * travels[name] / room for name, room in rooms.items()}),
        springs=_most({n: 100.0 * shortenings[n] / end for n, end in ends.items() if end > 0.0}),
    )


def _most(percents: dict[str, float]) -> Use | None:
    if not percents:
        return None
    name = max(percents, key=lambda name: percents[name])
    return Use(name, percents[name])


def beyond_range(front: Front, vehicle: Vehicle) -> list[Reason]:
    """Return remarks on springs and sheets that went beyond what their curve or path is known for.

    Parameters
    ----------
    front : Front
        Force over shortening, mm, by the springs' names; displacements of the groups, mm.
    vehicle : Vehicle
        A curve is known up to the shortening that was `seen` in its extraction, else up to its last point.
    """
    said = []
    for name, spring in vehicle.springs.items():
        if name not in front.springs or (spring.bottoming is not None and spring.seen is None):
            continue
        end = float(spring.loading[-1][0]) + float(spring.gap or 0.0)
        last = (end if spring.seen is None else float(spring.seen)) * 1e3
        most = max((float(point[0]) for point in front.springs[name].points), default=0.0)
        if most > RANGE * last:
            said.append(Reason.of("spring-beyond-range", spring=name, shortening=most, last=last))
    for name, sheet in vehicle.sheets.items():
        last, most = 1e3 * float(sheet.path[-1][0]), _progress(front, sheet)
        if most > RANGE * last:
            said.append(Reason.of("sheet-beyond-path", sheet=name, progress=most, last=last))
    return said


def _progress(front: Front, sheet: FrontSheet) -> float:
    """Return how far both groups of a sheet were pushed in at most, in the mean, mm."""
    moved = [
        front.displacement.series[end].values for end in sheet.between if end in front.displacement.series
    ]
    if len(moved) < len(sheet.between):
        return 0.0
    return max((0.5 * (float(a) + float(b)) for a, b in zip(*moved, strict=True)), default=0.0)
