"""Notes of a result: what a reader should know of procedure, corridors, recording and conditioning."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.grading.measure import NoInterval
from certkit.signals.cfc import EDITION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult
    from certkit.grading.measure_all import Measurements


def result_notes(
    measured: Measurements, criteria: Sequence[CriterionResult], notes: Sequence[str] = ()
) -> list[str]:
    """Gather the notes, each once, in the order procedure, `notes`, corridors, filters, recording, interval.

    Parameters
    ----------
    measured : Measurements
    criteria : sequence of CriterionResult
        Graded; a note that several share is told once, with their ids.
    notes : sequence of str
        Further ones, such as the header of a data file.
    """
    said = [*measured.procedure.notes, *notes]
    told = dict.fromkeys(criterion.note for criterion in criteria if criterion.note)
    said += [f"{', '.join(c.id for c in criteria if c.note == note)}: {note}" for note in told]
    if any(c.filter != "none" for c in measured.procedure.criteria):
        said.append(f"Filters: {EDITION}, run forward and backward.")
    recording = measured.recording
    said += recording.notes
    said += [f"{c.name}: {note}" for c in recording.channels.values() for note in c.notes]
    if not isinstance(measured.interval, NoInterval):
        words = measured.interval.words
        said.append(f"{words[0].upper()}{words[1:]}.")
    return list(dict.fromkeys(said))
