"""One impact point under one scheme: each criterion against its limit, or its points."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.campaign_report import JudgedCriterion, JudgedPoint
from certkit.documents.result import CriterionResult
from certkit.documents.verdicts import worst
from certkit.grading.quantities import in_unit
from certkit.grading.scores import grade_scores
from certkit.reasons import Reason

if TYPE_CHECKING:
    from certkit.documents.campaign_report import PointReport, PointValue, SourceReport
    from certkit.documents.result import Verdict
    from certkit.grading.scheme_terms import SchemeTerms


def judge_point(terms: SchemeTerms, point: PointReport) -> JudgedPoint | None:
    """Judge a point by its own values; None where it has no source at all.

    The source that decides is the first in the order measured, finite elements, lumped, predicted. One that
    cannot be used is not passed over: the point is not evaluated then.
    """
    source = next((source for source in point.sources if source.decides), None)
    if source is None:
        return None
    if not source.usable:
        return _without_values(terms, point, source)
    values = {value.id: value for value in source.values}
    judge = _by_scores if terms.kind == "points" else _by_limits
    return judge(terms, point, source, values)


def nothing_known(terms: SchemeTerms, point: str, reason: Reason) -> JudgedPoint:
    """Return the judgement of a point without any value: not evaluated, and worth nothing."""
    judged = JudgedPoint(point=point, basis="none", coded_reason=reason)
    if terms.kind == "points":
        return judged.model_copy(update={"points": 0.0, "maximum": _maximum(terms)})
    return judged.model_copy(update={"verdict": "not evaluated"})


def _without_values(terms: SchemeTerms, point: PointReport, source: SourceReport) -> JudgedPoint:
    judged = nothing_known(terms, point.name, source.coded_reason or Reason.words(source.reason))
    verdict: Verdict | None = None
    if terms.kind != "points":
        verdict = "error" if source.verdict == "error" else "not evaluated"
    return judged.model_copy(update={"basis": "own", "source": source.kind, "verdict": verdict})


def _by_limits(
    terms: SchemeTerms, point: PointReport, source: SourceReport, values: dict[str, PointValue]
) -> JudgedPoint:
    rows = []
    missing: list[Reason] = []
    for name in terms.criteria:
        value = values.get(name)
        if value is None or value.value is None:
            missing.append(Reason.of("value-lacking", criterion=name, reason=why_lacking(value)))
            continue
        limit = terms.limit(name, value.unit, relaxed=point.relaxed)
        verdict: Verdict = "pass"
        if not terms.keeps(name, value.value, value.unit, relaxed=point.relaxed):
            verdict = "fail"
        elif value.guard is not None and value.value > limit - value.guard:
            verdict = "conditional"
        percent = 100.0 * value.value / limit
        rows.append(
            JudgedCriterion(
                id=name, unit=value.unit, value=value.value, limit=limit, percent=percent, verdict=verdict
            )
        )
    verdicts: list[Verdict] = [row.verdict for row in rows if row.verdict is not None]
    if missing:
        verdicts.append("not evaluated")
    decisive = max(rows, key=lambda row: row.percent or 0.0, default=None)
    return JudgedPoint(
        point=point.name,
        basis="own",
        source=source.kind,
        criteria=rows,
        worst=decisive.id if decisive else "",
        percent=decisive.percent if decisive else None,
        verdict=worst(verdicts),
        coded_reason=_together(missing),
    )


def _by_scores(
    terms: SchemeTerms, point: PointReport, source: SourceReport, values: dict[str, PointValue]
) -> JudgedPoint:
    usable = {
        name: CriterionResult(id=name, title=each.title, value=each.value, unit=each.unit, verdict="pass")
        for name, each in values.items()
        if each.value is not None
    }
    given, missing = grade_scores(terms.corridors.scores, usable)
    rows = _score_rows(terms, values, usable)
    decisive = min(given, key=lambda score: score.points / score.maximum, default=None)
    shown = next((row for row in rows if decisive is not None and row.id == decisive.criterion), None)
    return JudgedPoint(
        point=point.name,
        basis="own",
        source=source.kind,
        criteria=rows,
        worst=shown.id if shown else "",
        percent=shown.percent if shown else None,
        points=sum(score.points for score in given),
        maximum=_maximum(terms),
        shares={score.id: score.points / score.maximum for score in given},
        coded_reason=_together([_unearned(reason) for reason in missing]),
    )


def why_lacking(value: PointValue | None) -> Reason:
    """Return why a criterion has no value."""
    if value is None:
        return Reason.of("no-value")
    return value.coded_reason or (Reason.words(value.reason) if value.reason else Reason.of("no-value"))


def _together(reasons: list[Reason]) -> Reason | None:
    """Return several reasons as one; None where there are none."""
    return Reason.of("several-reasons", reasons=reasons) if reasons else None


def _unearned(reason: Reason) -> Reason:
    """Say which criteria are missing, so that a score earns nothing."""
    names = reason.parameters.get("criteria")
    return Reason.of("score-earns-nothing", criteria=names if isinstance(names, list) else [])


def _score_rows(
    terms: SchemeTerms, values: dict[str, PointValue], usable: dict[str, CriterionResult]
) -> list[JudgedCriterion]:
    """Return each criterion with the share that it would earn alone."""
    rows: dict[str, JudgedCriterion] = {}
    for name, score in terms.corridors.scores.items():
        scales = [(each, scale.full, scale.zero) for scale in score.scales for each in scale.criteria]
        if score.forfeit is not None:
            scales += [(each, score.forfeit.at, score.forfeit.at) for each in score.forfeit.criteria]
        for each, full, zero in scales:
            if each not in usable or each in rows:
                continue
            change = {"criteria": [each], "full": full, "zero": zero, "also": [], "forfeit": None}
            (alone,), _ = grade_scores({name: score.model_copy(update=change)}, usable)
            value, unit, where = usable[each].value or 0.0, values[each].unit, f"score {name}, {each}"
            limit = in_unit(zero, unit, where)
            rows[each] = JudgedCriterion(
                id=each,
                unit=unit,
                value=value,
                limit=limit,
                full=in_unit(full, unit, where),
                percent=100.0 * value / limit,
                share=alone.points / alone.maximum,
            )
    return list(rows.values())


def _maximum(terms: SchemeTerms) -> float:
    return sum(score.points for score in terms.corridors.scores.values())
