"""The plausibility gate: values that could be read but are no evidence, told before anything is graded.

It holds for measured, finite-element and simulated recordings alike. A criterion that falls here is `not
evaluated`, with the reason beside the verdict. Static tests have load levels instead of a peak and pass.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from certkit.errors import DataError
from certkit.grading.measure import NoInterval, evaluated
from certkit.grading.measures import method_of
from certkit.grading.plausible_channels import doubtful_channels
from certkit.grading.trace import trace_of
from certkit.reasons import Reason
from certkit.signals.plausibility_record import BEGIN_TOLERANCE, edge_of_peak, level_at_end, loaded_before

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from certkit.definitions.procedure import Criterion, Procedure
    from certkit.grading.measured_value import MeasuredValue
    from certkit.grading.trace import EvaluationWindow, Trace
    from certkit.signals import AssessmentInterval, Filtered

CROSSING_KEPT = frozenset({"clipped", "clipped-kept", "unit-out-by-ten"})
"""Doubts of a bone channel that leave its zero crossing, and so the assessment interval, where it is."""
BEYOND = 0.001
"""Seconds by which a record has to go beyond the evaluation window, so that the window, and not the record's
end, ended the search for a peak."""


class Plausibility(Struct, frozen=True):
    """What the gate found.

    Parameters
    ----------
    values : mapping of str to MeasuredValue
        By criterion id, those that are no evidence with their `doubt`.
    remarks : tuple of Reason
        Oddities that no criterion falls for.
    """

    values: Mapping[str, MeasuredValue]
    remarks: tuple[Reason, ...] = ()


def plausible(
    procedure: Procedure,
    filtered: Filtered,
    window: EvaluationWindow,
    interval: AssessmentInterval | NoInterval,
    values: Mapping[str, MeasuredValue],
) -> Plausibility:
    """Doubt what is no evidence.

    Parameters
    ----------
    procedure : Procedure
    filtered : Filtered
        The conditioned recording.
    window, interval
        As the criteria were measured in.
    values : mapping of str to MeasuredValue
        What was measured, by criterion id.
    """
    if procedure.test_kind == "static" or filtered.recording.time.size < 2:
        return Plausibility(values)
    graded = [criterion for criterion in procedure.criteria if criterion.corridor is not None]
    spans = [evaluated(criterion, window, interval) for criterion in graded or procedure.criteria]
    decided = max((span.end for span in spans), default=window.end)
    channels = doubtful_channels(filtered, window, decided)
    shaken = _shaken_interval(filtered, channels.doubts)
    checked = {}
    for criterion in procedure.criteria:
        value = values[criterion.id]
        named = _channels(criterion, filtered)
        doubt = next((channels.doubts[name] for name in named if name in channels.doubts), None)
        if doubt is None and criterion.interval == "assessment interval":
            doubt = shaken
        if value.value is None and value.trace is None:
            # What is wrong with the channels tells more than that there is no interval.
            known = criterion.interval == "assessment interval" and doubt is not None and value.reason
            checked[criterion.id] = replace(value, reason=doubt) if known else value
            continue
        if doubt is None:
            doubt = _Peak(criterion, filtered, window, interval, procedure.run.until).doubt(value)
        checked[criterion.id] = value if doubt is None else replace(value, doubt=doubt)
    return Plausibility(checked, channels.remarks)


def _shaken_interval(filtered: Filtered, doubts: Mapping[str, Reason]) -> Reason | None:
    """Return why the assessment interval is no evidence: a bone that helps to end it is not."""
    for name in filtered.recording.table.bone:
        found = doubts.get(name)
        if found is not None and found.code not in CROSSING_KEPT:
            return Reason.of("interval-rests-on-doubt", channel=name, reason=found)
    return None


def _channels(criterion: Criterion, filtered: Filtered) -> list[str]:
    table = filtered.recording.table
    curve = criterion.curve
    words = [criterion.channel, *((curve.y, curve.x) if curve is not None else ())]
    return [table.name(name) for name in words if name is not None]


class _Peak(Struct, frozen=True):
    """One criterion's peak within what was recorded."""

    criterion: Criterion
    filtered: Filtered
    window: EvaluationWindow
    interval: AssessmentInterval | NoInterval
    until: float | None

    def doubt(self, value: MeasuredValue) -> Reason | None:
        """Return why the value is no peak, or None."""
        time = self.filtered.recording.time
        if time[0] > BEGIN_TOLERANCE:
            return Reason.of("record-begins-late", start=float(time[0]) * 1e3)
        if not method_of(self.criterion.measure).rests_on_peak or value.time is None:
            return None
        try:
            trace = trace_of(self.criterion, self.filtered, self._span())
        except DataError:
            return None
        signed = self._signed(trace.y)
        index = int(signed.argmax())
        step = self.filtered.recording.interval
        peak_time = float(trace.time[index]) * 1e3
        edge = edge_of_peak(signed, index, step)
        if edge == "first":
            return Reason.of("peak-at-first-sample", time=peak_time)
        if edge == "last":
            return Reason.of("peak-at-last-sample", time=peak_time)
        return self._early(signed, index) or self._unfinished(trace, float(signed[index]))

    def _span(self) -> EvaluationWindow:
        return evaluated(self.criterion, self.window, self.interval)

    def _signed(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the values so that the peak is their largest one."""
        return method_of(self.criterion.measure).turned(values)

    def _early(self, signed: NDArray[np.float64], index: int) -> Reason | None:
        """Return whether the channel is loaded before contact, or at the first sample."""
        recording = self.filtered.recording
        name = _channels(self.criterion, self.filtered)[0]
        kind = recording.table.kinds.get(name)
        if kind is None or kind.amplitude_class is None:
            return None
        contact = max(0, int(recording.time.searchsorted(0.0, side="right")) - 1)
        values = self.filtered.values(name, self.criterion.filter)
        found = loaded_before(values, contact, abs(float(signed[index])), kind.amplitude_class)
        if found is None:
            return None
        unit, scale = kind.dimension.unit, kind.dimension.scale
        return Reason.of("loaded-before-contact", value=found * scale, unit=unit)

    def _unfinished(self, trace: Trace, peak: float) -> Reason | None:
        """Return whether the record ends before the peak can be known to be over."""
        if isinstance(self.interval, NoInterval) or self.criterion.interval == "whole":
            end = float(self.filtered.recording.time[-1])
            if peak <= 0 or (self.until is not None and end > float(self.until) + BEYOND):
                return None
            share = level_at_end(self._signed(trace.y), peak, self.filtered.recording.interval)
            if share is not None:
                return Reason.of("record-ends-early", end=end * 1e3, share=share)
        return None
