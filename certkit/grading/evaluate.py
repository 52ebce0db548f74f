"""From what was measured to the result document: the same way for simulated and for measured tests."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.documents.channel_curves import drawn_curves, raw_channels
from certkit.documents.result import Result
from certkit.grading.criterion import Judgement, grade_criterion
from certkit.grading.foundation import foundation
from certkit.grading.grading_terms import (
    NO_LABORATORY,
    NOT_SIMULATED,
    GradingTerms,
    LaboratoryTerms,
    SimulatedTerms,
)
from certkit.grading.interval_edge import interval_edge
from certkit.grading.laboratory_doubts import laboratory_doubts
from certkit.grading.overall_verdict import overall
from certkit.grading.preconditions import grade_preconditions
from certkit.grading.reference_errors import compare
from certkit.grading.remarks import assumptions, left_ungraded, remarks
from certkit.grading.result_notes import result_notes
from certkit.grading.scores import procedure_scores

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.procedure import Procedure
    from certkit.documents.result import CriterionResult, ResultKind
    from certkit.grading.measure_all import Measurements
    from certkit.reasons import Reason
    from certkit.signals.recording import RecordingKind


KINDS: dict[RecordingKind, ResultKind] = {
    "simulated": "virtual certification",
    "virtual": "virtual test",
    "measured": "test evaluation",
}
"""Kind of the document by the kind of the recording."""


def evaluate(
    measured: Measurements,
    terms: GradingTerms,
    *,
    simulated: SimulatedTerms = NOT_SIMULATED,
    laboratory: LaboratoryTerms = NO_LABORATORY,
    notes: Sequence[Reason] = (),
) -> Result:
    """Grade what was measured by a procedure, and write the result document.

    Parameters
    ----------
    measured : Measurements
        From `certkit.grading.measure_all`.
    terms : GradingTerms
        Corridors, reference and origins.
    simulated : SimulatedTerms
        Of a simulated run: its quality, numerical uncertainty, motion, energies and vehicle front.
    laboratory : LaboratoryTerms
        Of a measured test: decision rule, uncertainties, checks of its sensors, header.
    notes : sequence of Reason
        Further notes, such as the header of a data file.

    Returns
    -------
    Result
        With its id; its reasons are codes yet, without words.

    Raises
    ------
    UsageError
        When definitions do not fit together (units, kinds of corridor).
    """
    procedure, recording = measured.procedure, measured.recording
    judgement = Judgement(
        terms.corridors, laboratory.decision, laboratory.uncertainties, simulated.numerical, recording.table
    )
    criteria = [grade_criterion(c, measured.values[c.id], judgement) for c in procedure.criteria]
    preconditions = [*grade_preconditions(procedure.preconditions, recording), *laboratory.checks]
    kind: ResultKind = KINDS[recording.kind]
    sound = {c.id: c for c in criteria if measured.values[c.id].doubt is None}
    scores, unscored = procedure_scores(procedure.score, terms.corridors, sound, recording.table)
    comparison = None if terms.reference is None else compare(terms.reference, criteria)
    said = remarks(
        kind,
        criteria,
        preconditions=preconditions,
        quality=simulated.quality,
        parameters=terms.parameters,
        comparison=comparison,
        oddities=[
            *assumptions(recording),
            *laboratory_doubts(laboratory, criteria, preconditions, recording.table),
            *measured.remarks,
            *interval_edge(measured, criteria),
            *simulated.bounds,
            *left_ungraded(procedure, terms.corridors),
        ],
    )
    verdict = overall(criteria, preconditions, simulated.quality)
    if verdict == "pass":
        model = simulated.legform or procedure.specimen.legform
        rests = foundation(
            measured,
            criteria,
            preconditions,
            model=model if recording.kind == "simulated" else "",
            fitted=simulated.fitted,
        )
        said = [*rests, *said]
    result = Result(
        kind=kind,
        procedure=procedure.procedure,
        title=procedure.title,
        verdict=verdict,
        coded_remarks=[*said, *unscored],
        method=procedure.method.words,
        specimen=_specimen(kind, procedure, simulated, laboratory),
        coded_decision_rule=laboratory.decision.reason,
        criteria=criteria,
        preconditions=preconditions,
        conditions=_finite(recording.conditions),
        scores=scores,
        comparison=comparison,
        quality=simulated.quality,
        interval=measured.interval_ends,
        energies=simulated.energies,
        front=simulated.front,
        curves=drawn_curves(measured.filtered, measured.drawn_filters(), measured.window.end),
        channels=raw_channels(measured.raw),
        motion=simulated.motion,
        parameters=list(terms.parameters),
        laboratory=None if laboratory.header is None else dict(laboratory.header),
        coded_notes=result_notes(measured, criteria, notes),
        provenance=terms.provenance,
    )
    return result.with_id()


def criterion_values(measured: Measurements) -> dict[str, float | None]:
    """Return the values alone, in the units at the borders, by criterion id: refined runs are compared by it.

    For whole curves it is the largest ordinate.
    """
    blank = Judgement({}, channels=measured.recording.table)
    uncovered = [c.model_copy(update={"corridor": None}) for c in measured.procedure.criteria]
    return {c.id: grade_criterion(c, measured.values[c.id], blank).value for c in uncovered}


def grade_criteria(measured: Measurements, corridors: Mapping[str, CorridorSet]) -> list[CriterionResult]:
    """Return the criteria alone, by simple acceptance: studies grade thousands of runs by it."""
    judgement = Judgement(corridors, channels=measured.recording.table)
    return [grade_criterion(c, measured.values[c.id], judgement) for c in measured.procedure.criteria]


def _specimen(
    kind: ResultKind, procedure: Procedure, simulated: SimulatedTerms, laboratory: LaboratoryTerms
) -> dict[str, str]:
    """Say what was on the rig; a simulated leg's title or the laboratory's serial number tells more."""
    specimen = {
        "legform": procedure.specimen.legform,
        "part": procedure.specimen.part,
        "flesh": procedure.specimen.flesh,
    }
    if procedure.vehicle is not None and kind == "virtual certification":
        specimen["vehicle"] = procedure.vehicle
    if simulated.legform:
        specimen["legform"] = simulated.legform
    return {**specimen, **laboratory.specimen}


def _finite(conditions: Mapping[str, float]) -> dict[str, float]:
    return {words: value for words, value in conditions.items() if math.isfinite(value)}
