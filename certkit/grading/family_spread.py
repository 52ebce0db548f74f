"""A result over a family of legs that all pass: the nominal leg's values with their spread."""

from __future__ import annotations

import math
from collections import Counter
from typing import TYPE_CHECKING

from certkit.documents.list_by_id import ListById
from certkit.documents.result import Spread
from certkit.errors import UsageError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult, Result

LOOSE = 0.1
"""Standard deviation over mean beyond which the certification tests do not determine a value."""


def with_spread(results: Sequence[Result]) -> Result:
    """Return the first result with the spread of all of them.

    The first is the nominal leg: its values, curves and verdict stay. The members differ in what the
    certification tests leave open, so the verdict is not made worse by one of them, but remarks say how many
    pass and what is not determined. A member whose run cannot be trusted is left out; remarks name it by its
    number in the family, with the check that it misses, and likewise those that fail, which stay.

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
        raise UsageError("a spread is over one procedure; these results are of several; give results of one")
    trusted = [result for result in results[1:] if result.verdict != "error"]
    legs = [nominal, *trusted]
    criteria = []
    for criterion in nominal.criteria:
        spread = _spread([c for r in legs for c in r.criteria if c.id == criterion.id])
        criteria.append(criterion.model_copy(update={"spread": spread}) if spread is not None else criterion)
    remarks = [*nominal.coded_remarks, _remark(legs)]
    members = list(enumerate(results[1:], 1))
    left_out = [_left_out(number, result) for number, result in members if result.verdict == "error"]
    if left_out:
        remarks.append(Reason.of("legs-dropped", count=len(left_out), legs=left_out))
    failing = [_failing(number, result) for number, result in members if result.verdict == "fail"]
    if failing:
        remarks.append(Reason.of("legs-that-fail", count=len(failing), legs=failing))
    remarks += [reason for criterion in criteria for reason in _undetermined(criterion)]
    return nominal.model_copy(update={"criteria": ListById(criteria), "coded_remarks": remarks}).with_id()


def _spread(criteria: Sequence[CriterionResult]) -> Spread | None:
    """Return the spread of a criterion over legs; the standard deviation is the sample's."""
    values = [criterion.value for criterion in criteria if criterion.value is not None]
    if len(values) < 2:
        return None
    mean = math.fsum(values) / len(values)
    variance = math.fsum((value - mean) ** 2 for value in values) / (len(values) - 1)
    verdicts = [criterion.verdict for criterion in criteria if criterion.graded]
    return Spread(
        members=len(values),
        minimum=min(values),
        maximum=max(values),
        mean=mean,
        standard_deviation=math.sqrt(variance),
        passing=verdicts.count("pass") / len(verdicts) if verdicts else None,
    )


def _left_out(number: int, result: Result) -> Reason:
    """Return a member's number with the quality checks that its run misses."""
    checks = result.quality.checks if result.quality is not None else []
    missed = [check.coded_title or Reason.words(check.title) for check in checks if check.verdict != "pass"]
    if not missed:
        return Reason.of("leg-number", number=number)
    return Reason.of("leg-that-misses", number=number, checks=missed)


def _failing(number: int, result: Result) -> Reason:
    """Return a member's number with the criteria that it fails."""
    failed = [
        criterion.id for criterion in result.criteria if criterion.graded and criterion.verdict == "fail"
    ]
    return Reason.of("leg-that-misses", number=number, checks=failed)


def _remark(results: Sequence[Result]) -> Reason:
    counts = Counter(result.verdict for result in results)
    verdicts = [
        Reason.of("count-of-verdict", count=count, verdict=verdict)
        for verdict, count in sorted(counts.items())
    ]
    return Reason.of("spread-over-family", legs=len(results), verdicts=verdicts)


def _undetermined(criterion: CriterionResult) -> list[Reason]:
    """Say of a graded criterion that some legs pass and others do not, and of any that it is not determined.

    A value is not determined where its standard deviation over the legs, which all pass the certification
    tests, is more than `LOOSE` of its mean.
    """
    spread = criterion.spread
    if spread is None:
        return []
    said = []
    if spread.passing is not None and spread.passing < 1:
        passed = round(spread.passing * spread.members)
        said.append(Reason.of("legs-that-pass", criterion=criterion.id, passed=passed, legs=spread.members))
    if spread.standard_deviation > LOOSE * abs(spread.mean):
        low, high = spread.minimum, spread.maximum
        said.append(
            Reason.of("not-determined", criterion=criterion.id, low=low, high=high, unit=criterion.unit)
        )
    return said
