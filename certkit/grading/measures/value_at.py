"""`value at`: the value of a channel at the instant when another one first reaches a level."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError, UsageError
from certkit.grading.measured_value import MeasuredValue
from certkit.grading.measures.measure_method import MeasureMethod
from certkit.grading.quantities import quantity
from certkit.grading.trace import trace_of
from certkit.reasons import Reason, reason_of

if TYPE_CHECKING:
    from certkit.definitions.procedure import Criterion
    from certkit.grading.trace import EvaluationWindow, Trace
    from certkit.signals import Filtered

REACHED = 1e-9
"""A level counts as reached this much (relative) below it: a relaxed load is never met to the last bit."""


class ValueAt(MeasureMethod):
    """y(t₁), with t₁ the first instant of |g(t)| ≥ |level| on the level's side of zero, for the guide g.

    Both channels are straight lines between samples.
    """

    def take(
        self, trace: Trace, criterion: Criterion, filtered: Filtered, window: EvaluationWindow
    ) -> MeasuredValue:
        """Return the value and its time, s; none where the level is never reached."""
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
