"""`max abs`: the largest magnitude of a channel, without its sign, and when it first occurs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

from certkit.grading.measures.measure_method import PeakMethod

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.definitions.procedure import Criterion
    from certkit.grading.measured_value import MeasuredValue
    from certkit.grading.trace import EvaluationWindow, Trace
    from certkit.signals import Filtered


class MaxAbs(PeakMethod):
    """max |y(t)|."""

    def turned(self, ordinates: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return |y|, of the same shape and unit."""
        return np.abs(ordinates)

    def take(
        self, trace: Trace, criterion: Criterion, filtered: Filtered, window: EvaluationWindow
    ) -> MeasuredValue:
        """Return the magnitude and its time, s."""
        found = super().take(trace, criterion, filtered, window)
        return replace(found, value=None if found.value is None else abs(found.value))
