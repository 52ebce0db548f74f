"""`time of max`: when a channel is highest, s after first contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from msgspec.structs import replace

from certkit.definitions.channels import TIME
from certkit.grading.measures.measure_method import PeakMethod

if TYPE_CHECKING:
    from certkit.definitions.procedure import Criterion
    from certkit.grading.measured_value import MeasuredValue
    from certkit.grading.trace import EvaluationWindow, Trace
    from certkit.signals import Filtered


class TimeOfMax(PeakMethod):
    """The t of max y(t)."""

    is_peak: ClassVar = False

    def take(
        self, trace: Trace, criterion: Criterion, filtered: Filtered, window: EvaluationWindow
    ) -> MeasuredValue:
        """Return the time twice: it is the value as well."""
        found = super().take(trace, criterion, filtered, window)
        return replace(found, value=found.time, dimension=TIME)
