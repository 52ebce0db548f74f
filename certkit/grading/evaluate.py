"""From a recording to the result document: the same way for simulated and for measured tests."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from certkit.documents.certificate_id import with_id
from certkit.documents.channel_curves import drawn_curves, raw_channels
from certkit.documents.result import Result
from certkit.documents.verdicts import worst
from certkit.errors import DataError
from certkit.grading.corridors import IMPACTOR
from certkit.grading.criterion import Judgement, grade_criterion
from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule
from certkit.grading.measure import EvaluationWindow, MeasuredValue, NoInterval, channel_name, measure
from certkit.grading.preconditions import grade_preconditions
from certkit.grading.reference_errors import compare
from certkit.grading.remarks import remarks
from certkit.grading.scores import grade_scores
from certkit.signals import AssessmentInterval, Filtered, assessment_interval, condition
from certkit.signals.cfc import EDITION
from certkit.signals.interval import BONE_CHANNELS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.procedure import Criterion, Procedure
    from certkit.definitions.reference import Reference
    from certkit.documents.result import (
        CriterionResult,
        Front,
        Histories,
        Kind,
        Motion,
        Parameter,
        PreconditionResult,
        Provenance,
        Quality,
        ScoreResult,
        Verdict,
    )
    from certkit.signals import Recording

INTERVAL_FILTER = "CFC 180"


@dataclass(frozen=True)
class _Taken:
    """What was measured on a conditioned recording."""

    filtered: Filtered
    window: EvaluationWindow
    interval: AssessmentInterval | NoInterval
    values: Mapping[str, MeasuredValue] = field(default_factory=dict)


def evaluate(  # noqa: PLR0913  # everything that a result carries comes in here
    procedure: Procedure,
    corridors: Mapping[str, CorridorSet],
    recording: Recording,
    *,
    provenance: Provenance,
    reference: Reference | None = None,
    quality: Quality | None = None,
    motion: Motion | None = None,
    energies: Histories | None = None,
    front: Front | None = None,
    parameters: Sequence[Parameter] = (),
    specimen: Mapping[str, str] | None = None,
    laboratory: Mapping[str, Any] | None = None,
    checks: Sequence[PreconditionResult] = (),
    decision: DecisionRule | None = None,
    uncertainties: Mapping[str, float] | None = None,
    numerical: Mapping[str, float] | None = None,
    notes: Sequence[str] = (),
    lenient: bool = False,
) -> Result:
    """Grade a recording by a procedure.

    Parameters
    ----------
    procedure : Procedure
    corridors : mapping of str to CorridorSet
        By name; a set that is not there makes its criteria `not evaluated`.
    recording : Recording
        As simulated or as read; conditioned here.
    provenance : Provenance
    reference : Reference, optional
        For the error table.
    quality : Quality, optional
        Of a simulated run, from `certkit.grading.quality_gate`.
    motion : Motion, optional
        The moving picture.
    energies : Histories, optional
        Energy over time.
    front : Front, optional
        What the vehicle's front did.
    parameters : sequence of Parameter
        Numbers that went in, with their origins.
    specimen : mapping of str to str, optional
        What was on the rig, beside what the procedure says of it: a serial number, a title.
    laboratory : mapping, optional
        Header data of a laboratory.
    checks : sequence of PreconditionResult
        Preconditions that the recording does not know of, such as a sensor's calibration date.
    decision : DecisionRule, optional
        Simple acceptance when missing.
    uncertainties : mapping of str to float, optional
        Expanded uncertainty U (k = 2) by channel, SI.
    numerical : mapping of str to float, optional
        Numerical uncertainty by criterion id, in the criterion's unit (`certkit.grading.refinement`).
    notes : sequence of str
    lenient : bool
        Keep clipped channels and turn swapped ones, with a note.

    Returns
    -------
    Result
        With its id.

    Raises
    ------
    DataError
        When a measured recording cannot be used: clipped, swapped, uneven time steps.
    UsageError
        When definitions do not fit together (units, kinds of corridor).
    """
    rule = decision or SIMPLE_ACCEPTANCE
    raw, recording = recording, condition(recording, procedure, lenient=lenient)
    taken = _take(procedure, recording)
    judgement = Judgement(corridors, rule, uncertainties or {}, numerical or {})
    criteria = [grade_criterion(c, taken.values[c.id], judgement) for c in procedure.criteria]
    preconditions = [*grade_preconditions(procedure.preconditions, recording), *checks]
    kind: Kind = "virtual certification" if recording.kind == "simulated" else "test evaluation"
    scores, unscored = _scores(procedure, corridors, criteria)
    comparison = None if reference is None else compare(reference, criteria)
    said = remarks(
        kind,
        criteria,
        preconditions=preconditions,
        quality=quality,
        parameters=parameters,
        comparison=comparison,
    )
    result = Result(
        kind=kind,
        procedure=procedure.procedure,
        title=procedure.title,
        verdict=overall(criteria, preconditions, quality),
        remarks=[*said, *unscored],
        method=procedure.method.words,
        specimen={**_specimen(procedure), **(specimen or {})},
        decision_rule=rule.words,
        criteria=criteria,
        preconditions=preconditions,
        conditions=_finite(recording.conditions),
        scores=scores,
        comparison=comparison,
        quality=quality,
        interval=None
        if isinstance(taken.interval, NoInterval)
        else (taken.interval.start, taken.interval.end),
        energies=energies,
        front=front,
        curves=drawn_curves(taken.filtered, _filters(procedure.criteria), taken.window.end),
        channels=raw_channels(raw),
        motion=motion,
        parameters=list(parameters),
        laboratory=None if laboratory is None else dict(laboratory),
        notes=_notes(procedure, recording, taken, criteria, notes),
        provenance=provenance,
    )
    return with_id(result)


def criterion_values(procedure: Procedure, recording: Recording) -> dict[str, float | None]:
    """Return the values alone, in the units at the borders, by criterion id: refined runs are compared by it.

    For whole curves it is the largest ordinate.
    """
    taken = _take(procedure, condition(recording, procedure))
    blank = Judgement({})
    uncovered = [c.model_copy(update={"corridor": None}) for c in procedure.criteria]
    return {c.id: grade_criterion(c, taken.values[c.id], blank).value for c in uncovered}


def grade_criteria(
    procedure: Procedure, corridors: Mapping[str, CorridorSet], recording: Recording
) -> list[CriterionResult]:
    """Return the criteria alone, by simple acceptance: studies grade thousands of runs by it."""
    taken = _take(procedure, condition(recording, procedure))
    judgement = Judgement(corridors)
    return [grade_criterion(c, taken.values[c.id], judgement) for c in procedure.criteria]


def overall(
    criteria: Sequence[CriterionResult],
    preconditions: Sequence[PreconditionResult] = (),
    quality: Quality | None = None,
) -> Verdict:
    """Return the verdict over a whole test.

    A run that cannot be trusted is an `error`. A required precondition that is not met makes the test `not
    evaluated`. Else the worst of the graded criteria decides; with none at all the test is `not evaluated`.
    """
    if quality is not None and quality.verdict != "pass":
        return "error"
    if any(row.verdict == "fail" or (row.required and row.verdict != "pass") for row in preconditions):
        return "not evaluated"
    return worst(criterion.verdict for criterion in criteria if criterion.graded)


def _take(procedure: Procedure, recording: Recording) -> _Taken:
    """Filter and measure."""
    wanted: list[tuple[str, str]] = [(name, c.filter) for c in procedure.criteria for name in _channels(c)]
    needs_interval = any(c.interval == "assessment interval" for c in procedure.criteria)
    if needs_interval:
        wanted += [(name, INTERVAL_FILTER) for name in BONE_CHANNELS]
    filtered = Filtered(recording, wanted)
    interval = _interval(filtered) if needs_interval else NoInterval("")
    until = procedure.run.until
    static = procedure.rig.loading_ram is not None
    start = float(recording.time[0]) if static and recording.time.size else 0.0
    end = float(recording.time[-1]) if recording.time.size else 0.0
    window = EvaluationWindow(start, end if static or until is None else min(end, float(until)))
    values = {c.id: measure(c, filtered, window, interval) for c in procedure.criteria}
    return _Taken(filtered, window, interval, values)


def _interval(filtered: Filtered) -> AssessmentInterval | NoInterval:
    """Find the assessment interval; it needs every bone moment, for the last of them ends it."""
    try:
        moments = {name: filtered.values(name, INTERVAL_FILTER) for name in BONE_CHANNELS}
    except DataError as error:
        return NoInterval(f"no assessment interval: {error}")
    found = assessment_interval(filtered.recording.time, moments)
    return found or NoInterval("no assessment interval: no bone moment has a maximum beyond 15 N·m")


def _channels(criterion: Criterion) -> list[str]:
    named = [criterion.channel, criterion.at.channel if criterion.at is not None else None]
    if criterion.curve is not None:
        named += [criterion.curve.x, criterion.curve.y]
    return [channel_name(words) for words in named if words is not None]


def _filters(criteria: Sequence[Criterion]) -> dict[str, str]:
    """Return the filter that each channel is drawn with: its first criterion's."""
    found: dict[str, str] = {}
    for criterion in criteria:
        for name in _channels(criterion):
            found.setdefault(name, criterion.filter)
    return found


def _scores(
    procedure: Procedure, corridors: Mapping[str, CorridorSet], criteria: Sequence[CriterionResult]
) -> tuple[list[ScoreResult], list[str]]:
    if procedure.score is None:
        return [], []
    found = corridors.get(procedure.score)
    if found is None:
        return [], [f"Scores are not given: the set `{procedure.score}` was not found."]
    if found.impactor != IMPACTOR:
        return [], [f"Scores are not given: `{procedure.score}` is for the {found.impactor}."]
    return grade_scores(found.scores, {c.id: c for c in criteria})


def _specimen(procedure: Procedure) -> dict[str, str]:
    specimen = {
        "legform": procedure.specimen.legform,
        "part": procedure.specimen.part,
        "flesh": procedure.specimen.flesh,
    }
    return {**specimen, "vehicle": procedure.vehicle} if procedure.vehicle is not None else specimen


def _finite(conditions: Mapping[str, float]) -> dict[str, float]:
    return {words: value for words, value in conditions.items() if math.isfinite(value)}


def _notes(
    procedure: Procedure,
    recording: Recording,
    taken: _Taken,
    criteria: Sequence[CriterionResult],
    notes: Sequence[str],
) -> list[str]:
    """Gather what a reader should know of procedure, corridors, recording and conditioning."""
    said = [*procedure.notes, *notes]
    told = dict.fromkeys(criterion.note for criterion in criteria if criterion.note)
    said += [f"{', '.join(c.id for c in criteria if c.note == note)}: {note}" for note in told]
    if any(c.filter != "none" for c in procedure.criteria):
        said.append(f"Filters: {EDITION}, run forward and backward.")
    said += recording.notes
    said += [f"{c.name}: {note}" for c in recording.channels.values() for note in c.notes]
    if isinstance(taken.interval, AssessmentInterval):
        said.append(f"{taken.interval.words[0].upper()}{taken.interval.words[1:]}.")
    return list(dict.fromkeys(said))
