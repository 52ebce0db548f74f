"""Notes of a result: what a reader should know of procedure, corridors, recording and conditioning."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.grading.measure import NoInterval
from certkit.reasons import Reason, each_once
from certkit.signals.cfc import EDITION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult
    from certkit.grading.measure_all import Measurements


def result_notes(
    measured: Measurements, criteria: Sequence[CriterionResult], notes: Sequence[Reason]
) -> list[Reason]:
    """Gather the notes, each once, in the order procedure, `notes`, corridors, filters, recording, interval.

    Parameters
    ----------
    measured : Measurements
    criteria : sequence of CriterionResult
        Graded; a note that several share is told once, with their ids.
    notes : sequence of Reason
        Further ones, such as the header of a data file.
    """
    said = [*map(Reason.words, measured.procedure.notes), *notes]
    told = dict.fromkeys(criterion.note for criterion in criteria if criterion.note)
    said += [
        Reason.of("note-of-criteria", criteria=[c.id for c in criteria if c.note == note], text=note)
        for note in told
    ]
    if any(c.filter != "none" for c in measured.procedure.criteria):
        said.append(Reason.of("filters", edition=EDITION))
    recording = measured.recording
    said += recording.notes
    said += [
        Reason.of("note-of-channel", channel=c.name, reason=note)
        for c in recording.channels.values()
        for note in c.notes
    ]
    if not isinstance(measured.interval, NoInterval):
        said.append(measured.interval.reason)
    return each_once(said)
