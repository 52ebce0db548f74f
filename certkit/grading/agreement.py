"""Hold a comparison against a rule: ratings, peaks and assessment criteria, each a line with its limit."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.definitions.units import parse_quantity
from certkit.documents.comparison import AgreementCheck
from certkit.documents.verdicts import worst
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from certkit.definitions.agreement_rule import AgreementRule, CriterionLimit
    from certkit.documents.comparison import ComparisonDocument
    from certkit.documents.result import Verdict


class LimitedCriterion(Struct, frozen=True):
    """A criterion that both tests have, with the limit that it was graded by.

    Parameters
    ----------
    id : str
    reference, other, limit : float
        In the criterion's unit.
    """

    id: str
    reference: float
    other: float
    limit: float


def hold_against(
    rule: AgreementRule, document: ComparisonDocument, criteria: Sequence[LimitedCriterion]
) -> tuple[list[AgreementCheck], Verdict]:
    """Hold a comparison against a rule.

    Parameters
    ----------
    rule : AgreementRule
    document : ComparisonDocument
        With ratings and errors.
    criteria : sequence of LimitedCriterion
        For r_AC and d_AC.

    Returns
    -------
    checks : list of AgreementCheck
        What cannot be asked is `not evaluated`.
    verdict : Verdict
        The worst of them.
    """
    checks = [*_ratings(rule, document), *_peaks(rule, document)]
    if rule.criteria is not None:
        checks += _criteria(rule.criteria, rule, criteria)
    return checks, worst(check.verdict for check in checks)


def _counts(rule: AgreementRule, name: str) -> bool:
    return not rule.channels or name in rule.channels


def _ratings(rule: AgreementRule, document: ComparisonDocument) -> Iterator[AgreementCheck]:
    if rule.rating is None:
        return
    rated = {r.channel: r for r in document.ratings if _counts(rule, r.channel)}
    names = list(dict.fromkeys([*rule.channels, *rated]))
    if rule.rating.each is not None:
        for name in names:
            found = rated.get(name)
            value = None if found is None else found.overall
            reason = (
                found.coded_reason if found is not None else Reason.of("channel-not-shared", channel=name)
            )
            yield _check("rating", name, value, rule.rating.each, "", least=True, reason=reason)
    if rule.rating.mean is not None:
        values = [r.overall for r in rated.values() if r.overall is not None]
        mean = sum(values) / len(values) if values and len(values) == len(names) else None
        reason = Reason.of("mean-of-some", rated=len(values), asked=len(names))
        yield _check("mean-rating", "", mean, rule.rating.mean, "", least=True, reason=reason)


def _peaks(rule: AgreementRule, document: ComparisonDocument) -> Iterator[AgreementCheck]:
    if rule.peak is None:
        return
    limit = 100 * parse_quantity(rule.peak.within, "ratio")
    errors = {row.channel: row.error_percent for row in document.rows if _counts(rule, row.channel)}
    for name in list(dict.fromkeys([*rule.channels, *errors])):
        value = None if name not in errors else abs(errors[name])
        reason = Reason.of("peak-not-compared", channel=name)
        yield _check("peak", name, value, limit, "%", least=False, reason=reason)
    if not errors and not rule.channels:
        yield _check("peak", "", None, limit, "%", least=False, reason=Reason.of("no-peak-compared"))


def _criteria(
    limits: CriterionLimit, rule: AgreementRule, criteria: Sequence[LimitedCriterion]
) -> Iterator[AgreementCheck]:
    above, within = (100 * parse_quantity(text, "ratio") for text in (limits.above, limits.within))
    asked = [c for c in criteria if _counts(rule, c.id)]
    for criterion in asked:
        near = 100 * abs(criterion.reference) / abs(criterion.limit)
        apart = 100 * abs(criterion.other - criterion.reference) / abs(criterion.limit)
        if near >= above:
            check = _check("criterion", criterion.id, apart, within, "%", least=False, reason=None)
            # d_AC has to stay below its limit, not on it.
            yield check if apart < within else check.model_copy(update={"verdict": "fail"})
    if not asked:
        reason = Reason.of("no-criterion-with-limit")
        yield _check("criterion", "", None, within, "%", least=False, reason=reason)


def _check(
    code: str,
    channel: str,
    value: float | None,
    limit: float,
    unit: str,
    *,
    least: bool,
    reason: Reason | None,
) -> AgreementCheck:
    if value is None:
        verdict: Verdict = "not evaluated"
    else:
        verdict = "pass" if (value >= limit if least else value <= limit) else "fail"
    return AgreementCheck(
        kind=code,
        channel=channel,
        value=value,
        lower=limit if least else None,
        upper=None if least else limit,
        unit=unit,
        verdict=verdict,
        coded_title=Reason.of(f"agreement-{code}", channel=channel),
        coded_reason=reason if value is None else None,
    )
