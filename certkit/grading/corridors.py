"""From the name of a corridor in a procedure to numbers in SI units, with their origin."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.definitions.channels import TIME, Dimension
from certkit.definitions.loading.channel_tables import default_channels
from certkit.definitions.measures import MEASURES
from certkit.errors import UsageError
from certkit.grading.quantities import quantity
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.corridor_set import Band, CorridorSet, Polygon, ValueWindow
    from certkit.definitions.procedure import Criterion
    from certkit.definitions.provenance import Confidence
    from certkit.grading.trace import Trace


class Corridor(Struct, frozen=True):
    """A corridor as the definitions hold it.

    Parameters
    ----------
    name : str
        `set/entry`.
    entry : ValueWindow, Polygon or Band
    source, confidence : str
        Its origin.
    """

    name: str
    entry: ValueWindow | Polygon | Band
    source: str
    confidence: Confidence


class Missing(Struct, frozen=True):
    """No corridor to hold a criterion against: why, and whether the criterion is required all the same."""

    reason: Reason
    required: bool


def find_corridor(
    criterion: Criterion, corridors: Mapping[str, CorridorSet], channels: ChannelTable
) -> Corridor | Missing:
    """Look a criterion's corridor up.

    A criterion without a corridor, or whose set awaits it, is informative. One whose set or entry is
    missing is required and cannot be evaluated: a missing corridor never passes.

    Raises
    ------
    UsageError
        When the corridor is of another kind than the measure needs.
    """
    if criterion.corridor is None:
        return _no_corridor()
    name, _, entry_name = criterion.corridor.partition("/")
    found = corridors.get(name)
    if found is None:
        return Missing(Reason.of("corridor-set-not-found", set=name), required=True)
    if not made_for(found, channels):
        return Missing(
            Reason.of("corridor-set-for-other", set=name, impactor=impactor_of(found)), required=True
        )
    if entry_name in found.awaited:
        return Missing(Reason.words(found.awaited[entry_name]), required=False)
    try:
        entry = found.entry(entry_name)
    except KeyError:
        return Missing(Reason.of("corridor-not-in-set", set=name, entry=entry_name), required=True)
    wanted = MEASURES[criterion.measure].corridor
    if not isinstance(entry, wanted):
        raise UsageError(
            f"criterion {criterion.id}: `{criterion.measure}` needs a {wanted.noun}, "
            f"but {criterion.corridor} is a {entry.noun if entry else 'missing'}"
        )
    return Corridor(criterion.corridor, entry, entry.source or "", entry.confidence or "estimated")


@cache
def _no_corridor() -> Missing:
    return Missing(Reason.of("no-corridor"), required=False)


def impactor_of(found: CorridorSet) -> str:
    """Return the impactor that a corridor set is for; that of the shipped legform where it names none."""
    return found.impactor or default_channels().impactor


def made_for(found: CorridorSet, channels: ChannelTable) -> bool:
    """Tell whether a corridor set is for a legform's impactor."""
    return impactor_of(found) == channels.impactor


def limits(
    corridor: Corridor, window: ValueWindow, dimension: Dimension
) -> tuple[float | None, float | None]:
    """Return lower and upper limit, SI; None where there is none."""
    where = f"corridor {corridor.name}"
    return (
        None if window.lower is None else quantity(window.lower, dimension, where),
        None if window.upper is None else quantity(window.upper, dimension, where),
    )


def polygon_corners(
    corridor: Corridor, polygon: Polygon, criterion: Criterion, trace: Trace, channels: ChannelTable
) -> NDArray[np.float64]:
    """Return the polygon's corners in the plane of the criterion's curve, SI, shape (k, 2)."""
    curve = criterion.curve
    drawn = None if curve is None else (channels.name(curve.x), channels.name(curve.y))
    if drawn != (channels.name(polygon.x), channels.name(polygon.y)):
        raise UsageError(
            f"corridor {corridor.name}: is a polygon of {polygon.y} over {polygon.x}, "
            f"which is not the plane of criterion {criterion.id}"
            "; name another corridor or plane"
        )
    return _line(corridor, polygon.points, trace.x_dimension, trace.y_dimension)


def band_lines(
    corridor: Corridor, band: Band, dimension: Dimension
) -> tuple[NDArray[np.float64] | None, NDArray[np.float64] | None]:
    """Return the lower and upper polyline of (time, value), SI, each of shape (k, 2) or None."""
    lower, upper = (
        None if points is None else _line(corridor, points, TIME, dimension)
        for points in (band.lower, band.upper)
    )
    return lower, upper


def _line(
    corridor: Corridor, points: Sequence[tuple[str, str]], x: Dimension, y: Dimension
) -> NDArray[np.float64]:
    where = f"corridor {corridor.name}"
    return np.array([(quantity(px, x, where), quantity(py, y, where)) for px, py in points], dtype=np.float64)
