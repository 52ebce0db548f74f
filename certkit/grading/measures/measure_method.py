"""What takes a measure: one class in one file for each measure that a criterion can name."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np

from certkit.grading.measured_value import MeasuredValue

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.definitions.procedure import Criterion
    from certkit.grading.trace import EvaluationWindow, Trace
    from certkit.signals import Filtered


class MeasureMethod:
    """Base of the measures; each overrides what concerns it, and at least `take`."""

    rests_on_peak: ClassVar[bool] = False
    """Whether the value is no evidence where the channel's peak may have been missed, or is not over."""

    is_peak: ClassVar[bool] = False
    """Whether the value is the largest of the `turned` ordinates: a longer window can only raise it."""

    def turned(self, ordinates: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the ordinates, shape (n,), SI, so that the peak that is looked for is their largest one."""
        return ordinates

    def take(
        self, trace: Trace, criterion: Criterion, filtered: Filtered, window: EvaluationWindow
    ) -> MeasuredValue:
        """Take the measure.

        Parameters
        ----------
        trace : Trace
            The criterion's channels within the window.
        criterion, filtered, window
            For measures that look at other channels as well.

        Raises
        ------
        UsageError
            When the criterion makes no sense.
        """
        raise NotImplementedError


class PeakMethod(MeasureMethod):
    """Base of measures whose value is the channel's at its peak."""

    rests_on_peak: ClassVar = True
    is_peak: ClassVar = True

    def take(
        self, trace: Trace, criterion: Criterion, filtered: Filtered, window: EvaluationWindow
    ) -> MeasuredValue:
        """Return the channel's value at the first sample that is as large as any, and its time, s."""
        del criterion, filtered, window
        index = int(np.argmax(self.turned(trace.y)))
        return MeasuredValue(float(trace.y[index]), float(trace.time[index]), trace.y_dimension)


class CurveMethod(MeasureMethod):
    """Base of measures that hold a whole curve against a corridor; its distance to the border is graded."""

    def take(
        self, trace: Trace, criterion: Criterion, filtered: Filtered, window: EvaluationWindow
    ) -> MeasuredValue:
        """Return no value but the curve itself."""
        del criterion, filtered, window
        return MeasuredValue(None, None, trace.y_dimension, trace=trace)
