"""Sentences that stand next to a verdict: what it rests on, and what it does not cover."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from certkit.definitions.provenance import Confidence
    from certkit.documents.result import (
        Comparison,
        CriterionResult,
        Kind,
        Parameter,
        PreconditionResult,
        Quality,
    )

TITLES: dict[Kind, str] = {
    "virtual certification": (
        "A virtual certification of the model; not a calibration certificate of a legform."
    ),
    "test evaluation": "An evaluation of a measured test; not a calibration certificate of the legform.",
}

_RESTS: dict[Confidence, str] = {
    "recalled": "recalled corridors, not verified against the regulation's text",
    "derived": "derived corridors, which follow by arithmetic from their sources",
    "calibrated": "calibrated limits, which were fitted",
    "estimated": "estimated corridors, which are a judgement",
}


def remarks(
    kind: Kind,
    criteria: Sequence[CriterionResult],
    *,
    preconditions: Sequence[PreconditionResult] = (),
    quality: Quality | None = None,
    parameters: Sequence[Parameter] = (),
    comparison: Comparison | None = None,
) -> list[str]:
    """Return the remarks of a result, the weightiest first."""
    said: list[str] = []
    if quality is not None:
        beyond = [check for check in quality.checks if check.verdict != "pass"]
        said += [
            f"The run cannot be trusted: {check.title} {check.value:.3g} {check.unit} "
            f"exceeds {check.limit:g} {check.unit}."
            for check in beyond
        ]
    said += [
        f"Not evaluated: {row.reason}." for row in preconditions if row.required and row.verdict != "pass"
    ]
    graded = [criterion for criterion in criteria if criterion.graded]
    if not graded:
        said.append("Not evaluated: no criterion has a corridor that it could be graded against.")
    said += [
        f"{c.id}: {c.reason}." for c in graded if c.verdict in {"not evaluated", "conditional"} and c.reason
    ]
    said += _confidence(graded)
    shown = [criterion.id for criterion in criteria if not criterion.graded]
    if shown and graded:
        said.append(f"Does not cover {_listed(shown)}: shown for information, no corridor is known.")
    if comparison is not None:
        said.append(_compared(comparison))
    if kind == "virtual certification" and parameters:
        said.append(_model(parameters))
    said.append(TITLES[kind])
    return said


def _confidence(graded: Iterable[CriterionResult]) -> list[str]:
    """Say what the corridors rest on, unless all of them were read in the regulation."""
    by_confidence: dict[Confidence, list[str]] = {}
    for criterion in graded:
        if criterion.confidence is not None and criterion.confidence != "verified":
            by_confidence.setdefault(criterion.confidence, []).append(criterion.id)
    return [
        f"Rests on {_RESTS[confidence]} ({_listed(names)})."
        for confidence, names in sorted(by_confidence.items())
    ]


def _compared(comparison: Comparison) -> str:
    said = f"Compared with {comparison.reference}: rms error {comparison.rms_error_percent:.1f} %"
    published = comparison.published_rms_error_percent
    return f"{said}." if published is None else f"{said} (the published simulation: {published:.1f} %)."


def _model(parameters: Sequence[Parameter]) -> str:
    counts: dict[str, int] = {}
    for parameter in parameters:
        counts[parameter.confidence] = counts.get(parameter.confidence, 0) + 1
    shares = [f"{count} {confidence}" for confidence, count in sorted(counts.items())]
    return (
        f"Of the {len(parameters)} numbers that went in, {_listed(shares)}; each is listed with its origin."
    )


def _listed(words: Sequence[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
