"""Measures: one number, and when it occurred, from the conditioned channels of a recording.

What cannot be measured (a channel is missing, holds NaN, is too slow for its filter) comes back without a
value and with the reason.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.channels import TIME, Dimension
from certkit.definitions.units import parse_quantity
from certkit.errors import DataError, UsageError
from certkit.reasons import Reason, UnusableError, reason_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from certkit.definitions.procedure import Criterion
    from certkit.signals import AssessmentInterval, Filtered

REACHED = 1e-9
"""A level counts as reached this much (relative) below it: a relaxed load is never met to the last bit."""


@dataclass(frozen=True)
class Trace:
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


@dataclass(frozen=True)
class MeasuredValue:
    """What was measured.

    Parameters
    ----------
    value, time : float or None
        SI value and the time it occurred at, s; None when it could not be measured.
    dimension : Dimension or None
        Of the value; None when not even the channel is known.
    reason : Reason or None
        Why there is no value.
    trace : Trace or None
        The samples, for measures that hold a whole curve against a corridor.
    doubt : Reason or None
        Why the value is no evidence though it could be read, from `certkit.grading.plausibility_gate`.
    """

    value: float | None
    time: float | None
    dimension: Dimension | None
    reason: Reason | None = None
    trace: Trace | None = None
    doubt: Reason | None = None


@dataclass(frozen=True)
class NoInterval:
    """There is no assessment interval, and why; without a reason where none was looked for."""

    reason: Reason | None = None


@dataclass(frozen=True)
class EvaluationWindow:
    """The part of the recording that counts, s; both ends belong to it."""

    start: float
    end: float


def quantity(text: str, dimension: Dimension, where: str) -> float:
    """Read a quantity of a channel's dimension, SI.

    Raises
    ------
    UsageError
        When its unit is not one of the dimension; `where` says in which definition it stands.
    """
    try:
        return parse_quantity(text, dimension.quantity)
    except ValueError as error:
        raise UsageError(f"{where}: {error}") from error


def measure(
    criterion: Criterion,
    filtered: Filtered,
    window: EvaluationWindow,
    interval: AssessmentInterval | NoInterval,
) -> MeasuredValue:
    """Measure a criterion.

    Parameters
    ----------
    criterion : Criterion
    filtered : Filtered
        The recording's channels through their filters.
    window : Window
        Seconds that are evaluated.
    interval : AssessmentInterval or NoInterval
        For criteria that are measured within it.

    Returns
    -------
    Measured

    Raises
    ------
    UsageError
        When the criterion itself makes no sense (`value at` without `at`, a unit that does not fit).
    """
    table = filtered.recording.table
    name = table.name(_ordinate(criterion))
    kind = table.find(name)
    known = filtered.recording.channels.get(name)
    dimension = known.dimension if known is not None else kind.dimension if kind is not None else None
    if criterion.interval == "assessment interval":
        if isinstance(interval, NoInterval):
            return MeasuredValue(None, None, dimension, interval.reason)
        window = EvaluationWindow(max(window.start, interval.start), min(window.end, interval.end))
    try:
        trace = trace_of(criterion, filtered, window)
    except DataError as error:
        return MeasuredValue(None, None, dimension, reason_of(error))
    if criterion.measure in {"curve in polygon", "curve in band"}:
        return MeasuredValue(None, None, trace.y_dimension, trace=trace)
    if criterion.measure == "value at":
        return _value_at(criterion, filtered, trace, window)
    index = _EXTREMES[criterion.measure](trace.y)
    value, time = float(trace.y[index]), float(trace.time[index])
    if criterion.measure == "time of max":
        return MeasuredValue(time, time, TIME)
    return MeasuredValue(abs(value) if criterion.measure == "max abs" else value, time, trace.y_dimension)


_EXTREMES: dict[str, Callable[[NDArray[np.float64]], int]] = {
    "max": lambda y: int(np.argmax(y)),
    "min": lambda y: int(np.argmin(y)),
    "max abs": lambda y: int(np.argmax(np.abs(y))),
    "time of max": lambda y: int(np.argmax(y)),
}


def _ordinate(criterion: Criterion) -> str:
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
    time = filtered.recording.time
    slack = 1e-9 + 1e-6 * abs(filtered.recording.interval) if time.size > 1 else 1e-9
    inside = (time >= window.start - slack) & (time <= window.end + slack)
    table = filtered.recording.table
    name = table.name(_ordinate(criterion))
    values = filtered.values(name, criterion.filter)
    if not inside.any():
        begin, end = window.start * 1e3, window.end * 1e3
        raise UnusableError(
            f"nothing was recorded from {begin:.6g} to {end:.6g} ms after contact",
            Reason.of("nothing-recorded", start=begin, end=end),
        )
    y = filtered.recording[name]
    if criterion.curve is None:
        return Trace(time[inside], time[inside], values[inside], "time", y.title, TIME, y.dimension)
    abscissa = table.name(criterion.curve.x)
    across = filtered.values(abscissa, criterion.filter)
    x = filtered.recording[abscissa]
    return Trace(time[inside], across[inside], values[inside], x.title, y.title, x.dimension, y.dimension)


def _value_at(
    criterion: Criterion, filtered: Filtered, trace: Trace, window: EvaluationWindow
) -> MeasuredValue:
    """Read the channel where another one first reaches a value, by straight lines between samples."""
    if criterion.at is None:
        raise UsageError(f"criterion {criterion.id}: `value at` needs `at: {{channel: …, equals: …}}`")
    name = filtered.recording.table.name(criterion.at.channel)
    guide = criterion.model_copy(update={"channel": name, "curve": None})
    try:
        path = trace_of(guide, filtered, window)
    except DataError as error:
        return MeasuredValue(None, None, trace.y_dimension, reason_of(error))
    level = quantity(criterion.at.equals, path.y_dimension, f"criterion {criterion.id}, `at`")
    sign = -1.0 if level < 0 else 1.0
    reached = np.flatnonzero(sign * path.y >= sign * level - REACHED * abs(level))
    if not reached.size:
        never = Reason.of("level-never-reached", channel=name, level=criterion.at.equals)
        return MeasuredValue(None, None, trace.y_dimension, never)
    index = int(reached[0])
    share = 1.0
    if index > 0:
        before, after = float(path.y[index - 1]), float(path.y[index])
        share = min(1.0, (level - before) / (after - before))
    previous = max(index - 1, 0)
    value = trace.y[previous] + share * (trace.y[index] - trace.y[previous])
    time = trace.time[previous] + share * (trace.time[index] - trace.time[previous])
    return MeasuredValue(float(value), float(time), trace.y_dimension)
