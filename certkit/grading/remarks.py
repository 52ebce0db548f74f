"""Remarks that stand next to a verdict: what it rests on, and what it does not cover."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.procedure import Procedure
    from certkit.definitions.provenance import Confidence
    from certkit.documents.result import (
        Comparison,
        CriterionResult,
        Parameter,
        PreconditionResult,
        Quality,
        QualityCheck,
        ResultKind,
    )
    from certkit.signals import Recording

TITLES: dict[ResultKind, str] = {
    "virtual certification": "model-not-legform",
    "virtual test": "simulated-by-others",
    "test evaluation": "no-calibration-certificate",
}
"""Code of what a document of each kind is not."""


def remarks(
    kind: ResultKind,
    criteria: Sequence[CriterionResult],
    *,
    preconditions: Sequence[PreconditionResult] = (),
    quality: Quality | None = None,
    parameters: Sequence[Parameter] = (),
    comparison: Comparison | None = None,
    oddities: Sequence[Reason] = (),
) -> list[Reason]:
    """Return the remarks of a result, the weightiest first.

    `oddities` are what the recording itself gives cause to say: assumptions, patterns, a knife edge.
    """
    said: list[Reason] = []
    if quality is not None:
        said += [untrusted(check) for check in quality.checks if check.verdict != "pass"]
    said += [
        Reason.of("test-not-evaluated", reason=_reason(row))
        for row in preconditions
        if row.required and row.verdict != "pass"
    ]
    graded = [criterion for criterion in criteria if criterion.graded]
    if not graded:
        said.append(Reason.of("no-criterion-graded"))
    said += [
        Reason.of("remark-on-criterion", criterion=c.id, reason=c.coded_reason)
        for c in graded
        if c.verdict in {"not evaluated", "conditional"} and c.coded_reason is not None
    ]
    said += oddities
    said += _run_limits(preconditions)
    said += _confidence(graded)
    shown = [criterion.id for criterion in criteria if not criterion.graded]
    if shown and graded:
        said.append(Reason.of("not-covered", criteria=shown))
    if comparison is not None:
        said.append(_compared(comparison))
    if kind != "test evaluation" and parameters:
        said.append(_model(parameters))
    said.append(Reason.of(TITLES[kind]))
    return said


ACCEPTED = "accepted-leniently"
"""Code of the remark on such a note."""
FROM_FILES = frozenset(
    {"assumed", "left-out", "questionable-data", "kind-not-said", "source-not-clear", "status-not-good"}
)
"""Codes of notes that only a recording's files tell; a document does not carry what they rest on."""
ASSUMED = FROM_FILES | {"clipped-kept", "sign-turned", "no-offset-removed"}
"""Codes of notes on a recording that stand for something that the data themselves do not show."""


def assumptions(recording: Recording) -> list[Reason]:
    """Return what was assumed of a recording, so that it stands beside the verdict."""
    said = [note for note in recording.notes if note.code in ASSUMED]
    said += [
        Reason.of("note-of-channel", channel=channel.name, reason=note)
        for channel in recording.channels.values()
        for note in channel.notes
        if note.code in ASSUMED
    ]
    return [Reason.of("accepted-leniently", reason=note) for note in said]


def file_note(reason: Reason) -> Reason | None:
    """Return the note of a file (of a channel, if so) that a remark or note passes on; else None."""
    if reason.code == ACCEPTED:
        inner = _within(reason)
        return None if inner is None else file_note(inner)
    named = _within(reason) if reason.code == "note-of-channel" else reason
    return reason if named is not None and named.code in FROM_FILES else None


def _within(reason: Reason) -> Reason | None:
    """Return the reason within a reason; None where there is none."""
    held = reason.parameters.get("reason")
    first = held[0] if isinstance(held, list) and held else None
    return first if isinstance(first, Reason) else None


def left_ungraded(procedure: Procedure, corridors: Mapping[str, CorridorSet]) -> list[Reason]:
    """Say which entries of a corridor set a procedure leaves out that grades by the others."""
    said = []
    for name, found in corridors.items():
        named = [c.corridor.partition("/") for c in procedure.criteria if c.corridor]
        used = {entry for owner, _, entry in named if owner == name}
        left = [entry for entry in found.entries if entry not in used]
        if used and left:
            said.append(Reason.of("corridor-not-graded", corridors=name, entries=left))
    return said


def _reason(row: PreconditionResult) -> Reason:
    """Return why a condition is not met; one without a code is told in its own words."""
    return row.coded_reason or Reason.words(row.reason)


def untrusted(check: QualityCheck) -> Reason:
    """Say which limit a run left that cannot be trusted, and what to do."""
    title = check.coded_title or Reason.words(check.title)
    value, limit, unit = check.value, check.limit, check.unit
    if check.remedy is None:
        return Reason.of("run-untrusted", check=title, value=value, limit=limit, unit=unit)
    return Reason.of(
        "run-untrusted-remedy", check=title, value=value, limit=limit, unit=unit, remedy=check.remedy
    )


def _confidence(graded: Iterable[CriterionResult]) -> list[Reason]:
    """Say what the corridors rest on, unless all of them were read in the regulation."""
    by_confidence: dict[Confidence, list[str]] = {}
    for criterion in graded:
        if criterion.confidence is not None and criterion.confidence != "verified":
            by_confidence.setdefault(criterion.confidence, []).append(criterion.id)
    return [
        Reason.of(f"rests-on-{confidence}", criteria=names)
        for confidence, names in sorted(by_confidence.items())
    ]


def _run_limits(preconditions: Sequence[PreconditionResult]) -> list[Reason]:
    """Say what the limits of a finite-element run's quality rest on, unless all were read in a text."""
    by_confidence: dict[Confidence, list[str]] = {}
    for row in preconditions:
        if row.confidence is not None and row.confidence != "verified":
            by_confidence.setdefault(row.confidence, []).append(row.quantity)
    return [
        Reason.of("run-limits-rest-on", confidence=confidence, quantities=names)
        for confidence, names in sorted(by_confidence.items())
    ]


def _compared(comparison: Comparison) -> Reason:
    reference, error = comparison.reference, comparison.rms_error_percent
    published = comparison.published_rms_error_percent
    if published is None:
        return Reason.of("compared", reference=reference, error=error)
    return Reason.of("compared-with-published", reference=reference, error=error, published=published)


def _model(parameters: Sequence[Parameter]) -> Reason:
    counts = Counter(parameter.confidence for parameter in parameters)
    shares = [
        Reason.of("count-of-confidence", count=count, confidence=confidence)
        for confidence, count in sorted(counts.items())
    ]
    return Reason.of("numbers-that-went-in", count=len(parameters), shares=shares)
