"""Comparisons as text for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import number_format as words
from certkit.reporting.plaintext import aligned

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.comparison import AgreementCheck, ComparisonDocument


def comparison_text(document: ComparisonDocument) -> str:
    """Return the comparison for a terminal: error table and ratings."""
    parts = [document.title]
    if document.rows:
        rows = [
            (
                row.channel,
                words.shown(row.test, row.unit),
                words.shown(row.simulation, row.unit),
                row.unit,
                f"{words.fixed(row.error_percent, 1)} %",
            )
            for row in document.rows
        ]
        heads = ("channel", document.reference.label, document.other.label, "unit", "error")
        parts.append(aligned(heads, rows, right=(1, 2, 4)))
        parts.append(f"rms error {words.fixed(document.rms_error_percent, 1)} %")
    ratings = [
        (
            rating.channel,
            *(words.fixed(v, 2) for v in (rating.corridor, rating.phase, rating.magnitude, rating.slope)),
            words.fixed(rating.overall, 2),
            rating.grade or f"not rated: {rating.reason}",
        )
        for rating in document.ratings
    ]
    parts_of_rating = ("ISO/TS 18571", "corridor", "phase", "magnitude", "slope", "overall", "grade")
    parts.append(aligned(parts_of_rating, ratings, right=(1, 2, 3, 4, 5)))
    causes = [f"{r.channel}: {'; '.join(r.causes)}" for r in document.ratings if r.causes]
    if causes:
        parts.append("\n".join(["Why ratings are not good:", *causes]))
    if document.rating is not None:
        parts.append(f"mean rating {words.fixed(document.rating, 2)}, {document.grade}")
    if document.verdict is not None:
        parts.append(_held(document))
    parts += [f"note: {note}" for note in document.notes]
    return "\n\n".join(parts[:-1]) + "\n" + parts[-1] if len(parts) > 1 else parts[0]


def _held(document: ComparisonDocument) -> str:
    """Return the rule's verdict with each of its lines that is not kept, and how many are."""
    kept = [check for check in document.checks if check.verdict == "pass"]
    verdict = document.verdict or ""
    sign = words.SIGNS.get(verdict, "")
    head = f"{sign} {verdict.upper()}  {document.rule}: {len(kept)} of {len(document.checks)} kept"
    return "\n".join([head, *(check_words(check) for check in document.checks if check.verdict != "pass")])


def check_words(check: AgreementCheck) -> str:
    """Return `Mean ISO/TS 18571 rating: 0.28, at least 0.8 asked`."""
    limit = f"at least {check.lower:g}" if check.lower is not None else f"at most {check.upper:g}"
    asked = f"{limit} {check.unit}".strip() + " asked"
    if check.value is None:
        return f"{check.title}: not known ({check.reason}); {asked}"
    value = words.fixed(check.value, 2 if check.lower is not None else 1)
    return f"{check.title}: {value} {check.unit}".rstrip() + f", {asked}"


def overview_text(documents: Sequence[ComparisonDocument]) -> str:
    """Return a line for each of several comparisons."""
    rows = [
        (
            document.title,
            words.fixed(document.rating, 2),
            document.grade or words.MISSING,
            f"{words.SIGNS.get(document.verdict or '', '')} {document.verdict or ''}".strip(),
        )
        for document in documents
    ]
    return aligned(("", "mean rating", "grade", "rule"), rows, right=(1,))
