"""The samples that a criterion is measured on: its channels, filtered and cut to the seconds that count."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.definitions.channels import TIME, Dimension
from certkit.errors import UsageError
from certkit.reasons import Reason, UnusableError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.procedure import Criterion
    from certkit.signals import Filtered


class Trace(Struct, frozen=True):
    """The samples that a criterion is measured on: abscissa and ordinate with their titles and units.

    Over time, `x` is the time and `x_dimension` is TIME.
    """

    time: NDArray[np.float64]
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    x_title: str
    y_title: str
    x_dimension: Dimension
    y_dimension: Dimension


class EvaluationWindow(Struct, frozen=True):
    """The part of the recording that counts, s; both ends belong to it."""

    start: float
    end: float


def ordinate(criterion: Criterion) -> str:
    """Return the channel that is measured."""
    name = criterion.curve.y if criterion.curve is not None else criterion.channel
    if name is None:
        raise UsageError(f"criterion {criterion.id}: names neither a `channel` nor a `curve`; add one")
    return name


def trace_of(criterion: Criterion, filtered: Filtered, window: EvaluationWindow) -> Trace:
    """Cut the criterion's channels to the window.

    Raises
    ------
    DataError
        When a channel is missing or cannot be used, or no sample lies in the window.
    """
    inside = filtered.within(window.start, window.end)
    time = filtered.recording.time[inside]
    table = filtered.recording.table
    name = table.name(ordinate(criterion))
    values = filtered.values(name, criterion.filter)
    if not time.size:
        begin, end = window.start * 1e3, window.end * 1e3
        raise UnusableError(
            f"nothing was recorded from {begin:.6g} to {end:.6g} ms after contact; export the whole record",
            Reason.of("nothing-recorded", start=begin, end=end),
        )
    y = filtered.recording[name]
    if criterion.curve is None:
        return Trace(time, time, values[inside], "time", y.title, TIME, y.dimension)
    abscissa = table.name(criterion.curve.x)
    across = filtered.values(abscissa, criterion.filter)
    x = filtered.recording[abscissa]
    return Trace(time, across[inside], values[inside], x.title, y.title, x.dimension, y.dimension)
