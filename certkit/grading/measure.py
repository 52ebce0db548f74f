"""Measures: one number, and when it occurred, from the conditioned channels of a recording.

What cannot be measured (a channel is missing, holds NaN, is too slow for its filter) comes back without a
value and with the reason.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import DataError
from certkit.grading.measured_value import MeasuredValue
from certkit.grading.measures import method_of
from certkit.grading.trace import EvaluationWindow, ordinate, trace_of
from certkit.reasons import Reason, reason_of

if TYPE_CHECKING:
    from certkit.definitions.procedure import Criterion
    from certkit.signals import AssessmentInterval, Filtered


class NoInterval(Struct, frozen=True):
    """There is no assessment interval, and why; without a reason where none was looked for."""

    reason: Reason | None = None


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
    window : EvaluationWindow
        Seconds that are evaluated.
    interval : AssessmentInterval or NoInterval
        For criteria that are measured within it.

    Returns
    -------
    MeasuredValue

    Raises
    ------
    UsageError
        When the criterion itself makes no sense (`value at` without `at`, a unit that does not fit).
    """
    table = filtered.recording.table
    name = table.name(ordinate(criterion))
    kind = table.find(name)
    known = filtered.recording.channels.get(name)
    dimension = known.dimension if known is not None else kind.dimension if kind is not None else None
    if criterion.interval == "assessment interval" and isinstance(interval, NoInterval):
        return MeasuredValue(None, None, dimension, interval.reason)
    window = evaluated(criterion, window, interval)
    try:
        trace = trace_of(criterion, filtered, window)
    except DataError as error:
        return MeasuredValue(None, None, dimension, reason_of(error))
    return method_of(criterion.measure).take(trace, criterion, filtered, window)


def evaluated(
    criterion: Criterion, window: EvaluationWindow, interval: AssessmentInterval | NoInterval
) -> EvaluationWindow:
    """Return the seconds that a criterion is measured in."""
    if criterion.interval != "assessment interval" or isinstance(interval, NoInterval):
        return window
    return EvaluationWindow(max(window.start, interval.start), min(window.end, interval.end))
