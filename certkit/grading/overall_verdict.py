"""The verdict over a whole test, from its criteria, its preconditions and the trust in the run."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.verdicts import worst

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult, PreconditionResult, Quality, Verdict


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
