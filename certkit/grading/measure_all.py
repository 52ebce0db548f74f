"""All measures of one recording: conditioned, filtered and cut once, for everything that needs them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import DataError
from certkit.grading.measure import NoInterval, measure
from certkit.grading.plausibility_gate import plausible
from certkit.grading.trace import EvaluationWindow
from certkit.reasons import Reason, reason_of
from certkit.signals import AssessmentInterval, Filtered, assessment_interval, condition

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.channels import ChannelTable
    from certkit.definitions.procedure import Criterion, Procedure
    from certkit.grading.measured_value import MeasuredValue
    from certkit.signals import Recording

INTERVAL_FILTER = "CFC 180"
"""Filter of the bone moments that the assessment interval is found on."""


class Measurements(Struct, frozen=True):
    """What was measured on one recording by one procedure.

    Parameters
    ----------
    procedure : Procedure
        By which it was measured.
    raw : Recording
        As simulated or as read.
    filtered : Filtered
        The conditioned recording (`recording`) and its channels through their filters.
    window : EvaluationWindow
        Seconds that are evaluated.
    interval : AssessmentInterval or NoInterval
        Where the criteria ask for one; else a `NoInterval` without a reason.
    values : mapping of str to MeasuredValue
        By criterion id, as the plausibility gate left them.
    remarks : tuple of Reason
        What the gate found odd.
    """

    procedure: Procedure
    raw: Recording
    filtered: Filtered
    window: EvaluationWindow
    interval: AssessmentInterval | NoInterval
    values: Mapping[str, MeasuredValue]
    remarks: tuple[Reason, ...] = ()

    @property
    def recording(self) -> Recording:
        """The conditioned recording."""
        return self.filtered.recording

    @property
    def interval_ends(self) -> tuple[float, float] | None:
        """Start and end of the assessment interval, s; None where there is none."""
        return None if isinstance(self.interval, NoInterval) else (self.interval.start, self.interval.end)

    def drawn_filters(self) -> dict[str, str]:
        """Return the filter that each channel is drawn with: that of its first criterion."""
        found: dict[str, str] = {}
        for criterion in self.procedure.criteria:
            for name in channels_of(criterion, self.recording.table):
                found.setdefault(name, criterion.filter)
        return found


def measure_all(procedure: Procedure, recording: Recording, *, lenient: bool = False) -> Measurements:
    """Condition a recording, filter its channels once, and measure every criterion.

    Parameters
    ----------
    procedure : Procedure
        Its criteria say what is measured, its fixtures and `run.until` where.
    recording : Recording
        As simulated or as read.
    lenient : bool
        Keep clipped channels and turn swapped ones, with a note.

    Raises
    ------
    DataError
        When a measured recording cannot be used: clipped, swapped, uneven time steps.
    UsageError
        When a criterion makes no sense.
    """
    conditioned = condition(recording, procedure, lenient=lenient)
    wanted: list[tuple[str, str]] = [
        (name, c.filter) for c in procedure.criteria for name in channels_of(c, recording.table)
    ]
    needs_interval = any(c.interval == "assessment interval" for c in procedure.criteria)
    if needs_interval:
        wanted += [(name, INTERVAL_FILTER) for name in recording.table.bone]
    filtered = _filtered(conditioned, wanted)
    interval = _interval(filtered) if needs_interval else NoInterval()
    window = _window(procedure, conditioned)
    values = {c.id: measure(c, filtered, window, interval) for c in procedure.criteria}
    gate = plausible(procedure, filtered, window, interval, values)
    return Measurements(procedure, recording, filtered, window, interval, gate.values, gate.remarks)


def _filtered(recording: Recording, wanted: Sequence[tuple[str, str]]) -> Filtered:
    """Filter the channels; what cannot be filtered is told with the file that it came from.

    Raises
    ------
    DataError
        When a channel is sampled too slowly, or was filtered too much already.
    """
    try:
        return Filtered(recording, wanted)
    except DataError as error:
        raise DataError(f"{recording.source or 'recording'}: {error}") from error


def channels_of(criterion: Criterion, table: ChannelTable) -> list[str]:
    """Return the short names of the channels that a criterion is measured on, by the legform's table."""
    named = [criterion.channel, criterion.at.channel if criterion.at is not None else None]
    if criterion.curve is not None:
        named += [criterion.curve.x, criterion.curve.y]
    return [table.name(words) for words in named if words is not None]


def _window(procedure: Procedure, recording: Recording) -> EvaluationWindow:
    """Return what is evaluated: static tests whole, others from contact until the procedure's end."""
    until = procedure.run.until
    static = procedure.test_kind == "static"
    start = float(recording.time[0]) if static and recording.time.size else 0.0
    end = float(recording.time[-1]) if recording.time.size else 0.0
    return EvaluationWindow(start, end if static or until is None else min(end, float(until)))


def _interval(filtered: Filtered) -> AssessmentInterval | NoInterval:
    """Find the assessment interval; it needs every bone moment, for the last of them ends it."""
    try:
        moments = {name: filtered.values(name, INTERVAL_FILTER) for name in filtered.recording.table.bone}
    except DataError as error:
        return NoInterval(Reason.of("no-assessment-interval", reason=reason_of(error)))
    found = assessment_interval(filtered.recording.time, moments)
    if isinstance(found, AssessmentInterval):
        return found
    return NoInterval(Reason.of("no-assessment-interval", reason=found))
