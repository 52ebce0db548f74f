"""A result over a family of legs that all pass: the nominal leg's values with their spread."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.documents.list_by_id import ListById
from certkit.documents.result import Spread
from certkit.errors import UsageError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult, Result


def with_spread(results: Sequence[Result]) -> Result:
    """Return the first result with the spread of all of them.

    The first is the nominal leg: its values, curves and verdict stay. The members differ in what the
    certification tests leave open, so the verdict is not made worse by one of them, but a remark says how
    many pass.

    Parameters
    ----------
    results : sequence of Result
        Of one procedure; the nominal leg first, then the members of the family.

    Raises
    ------
    UsageError
        When there are fewer than two results or they are not of one procedure.
    """
    if len(results) < 2:
        raise UsageError("a spread needs the nominal leg and at least one member of its family")
    nominal = results[0]
    if any(result.procedure != nominal.procedure for result in results):
        raise UsageError("a spread is over one procedure; these results are of several")
    criteria = []
    for criterion in nominal.criteria:
        values = [
            c.value for r in results for c in r.criteria if c.id == criterion.id and c.value is not None
        ]
        spread = _spread(values)
        criteria.append(criterion.model_copy(update={"spread": spread}) if spread is not None else criterion)
    remarks = [*nominal.coded_remarks, _remark(results), *_outside(criteria, results)]
    return nominal.model_copy(update={"criteria": ListById(criteria), "coded_remarks": remarks}).with_id()


def _spread(values: Sequence[float]) -> Spread | None:
    """Return the spread of at least two values; the standard deviation is the sample's."""
    if len(values) < 2:
        return None
    mean = math.fsum(values) / len(values)
    variance = math.fsum((value - mean) ** 2 for value in values) / (len(values) - 1)
    return Spread(
        members=len(values),
        minimum=min(values),
        maximum=max(values),
        mean=mean,
        standard_deviation=math.sqrt(variance),
    )


def _remark(results: Sequence[Result]) -> Reason:
    counts: dict[str, int] = {}
    for result in results:
        counts[result.verdict] = counts.get(result.verdict, 0) + 1
    verdicts = [
        Reason.of("count-of-verdict", count=count, verdict=verdict)
        for verdict, count in sorted(counts.items())
    ]
    return Reason.of("spread-over-family", legs=len(results), verdicts=verdicts)


def _outside(criteria: Sequence[CriterionResult], results: Sequence[Result]) -> list[Reason]:
    """Name graded criteria that some member does not pass."""
    said = []
    for criterion in criteria:
        verdicts = [c.verdict for r in results for c in r.criteria if c.id == criterion.id and c.graded]
        passed = verdicts.count("pass")
        if verdicts and passed < len(verdicts):
            said.append(
                Reason.of("legs-that-pass", criterion=criterion.id, passed=passed, legs=len(verdicts))
            )
    return said
