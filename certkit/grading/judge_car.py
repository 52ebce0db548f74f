"""A whole car under one scheme: points without values, total, worst point, verdict."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.campaign_report import JudgedScheme
from certkit.documents.verdicts import worst
from certkit.errors import UsageError
from certkit.grading.judge_point import judge_point, nothing_known
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.campaign_report import JudgedPoint, PointReport, SourceReport
    from certkit.documents.result import Verdict
    from certkit.grading.scheme_terms import SchemeTerms

SAME_PLACE = 0.5
"""mm within which a point on the other side mirrors one."""


def judge_car(terms: SchemeTerms, points: Sequence[PointReport], *, symmetric: bool) -> JudgedScheme:
    """Judge every point, let others stand for those without values where the scheme has a rule, and add up.

    The total is, summed over the scores, the car's points for a score times the mean share of all impact
    points, in which one without a value earns nothing.
    """
    judged = _filled(terms, points, symmetric=symmetric)
    decisive = max(judged, key=_badness)
    total, maximum = None, None
    if terms.kind == "points" and terms.car_points:
        mean = {
            name: sum(row.shares.get(name, 0.0) for row in judged) / len(judged) for name in terms.car_points
        }
        maximum = sum(terms.car_points.values())
        total = sum(points * mean[name] for name, points in terms.car_points.items())
    origins = terms.origins()
    return JudgedScheme(
        scheme=terms.scheme.scheme,
        title=terms.title,
        kind=terms.kind,
        verdict=_verdict(terms, judged, total, maximum),
        points=judged,
        worst_point=decisive.point if decisive.basis != "none" else "",
        total=total,
        maximum=maximum,
        percent=None if total is None or not maximum else 100.0 * total / maximum,
        at_least=terms.at_least,
        sources=list(dict.fromkeys(source for source, _ in origins)),
        confidences=list(dict.fromkeys(confidence for _, confidence in origins)),
        coded_remarks=[*_remarks(judged), *map(Reason.words, terms.scheme.notes)],
    )


def _filled(terms: SchemeTerms, points: Sequence[PointReport], *, symmetric: bool) -> list[JudgedPoint]:
    own = {point.name: _judged(terms, point) for point in points}
    rule = terms.scheme.untested
    known: dict[str, JudgedPoint] = {name: row for name, row in own.items() if row is not None}
    if rule is not None and rule.mirrored and symmetric:
        for point in points:
            other = next((p for p in points if abs(p.across + point.across) <= SAME_PLACE), None)
            found = own[other.name] if other is not None else None
            if point.name not in known and other is not None and found is not None:
                change = {"point": point.name, "basis": "mirrored", "of": other.name}
                known[point.name] = found.model_copy(update=change)
    if rule is not None and rule.neighbours is not None:
        known |= _from_neighbours(terms, points, dict(known), largest=rule.neighbours == "largest values")
    reason = Reason.of("point-without-source")
    return [known.get(p.name) or nothing_known(terms, p.name, reason) for p in points]


def _judged(terms: SchemeTerms, point: PointReport) -> JudgedPoint | None:
    try:
        return judge_point(terms, point)
    except UsageError as error:
        raise UsageError(f"point {point.name}: {error}") from error


def _from_neighbours(
    terms: SchemeTerms, points: Sequence[PointReport], known: dict[str, JudgedPoint], *, largest: bool
) -> dict[str, JudgedPoint]:
    """Let the nearest points on both sides stand for each point without a judgement.

    The worse of them, or the larger of both values of each criterion. Where several points without one lie
    beside each other, all take the same two, which is what passing larger values on from one to the next
    comes to.
    """
    found = {}
    for point in points:
        if point.name in known:
            continue
        left = [p for p in points if p.across < point.across and p.name in known]
        right = [p for p in points if p.across > point.across and p.name in known]
        beside = [max(left, key=lambda p: p.across)] if left else []
        beside += [min(right, key=lambda p: p.across)] if right else []
        if not beside:
            continue
        decisive = max((known[p.name] for p in beside), key=_badness)
        change = {"point": point.name, "basis": "neighbour", "of": decisive.point}
        if largest and len(beside) == 2:
            sources = [_source(points, known[p.name]) for p in beside]
            joined = point.model_copy(update={"sources": [_largest(*sources)]})
            decisive = judge_point(terms, joined) or decisive
            change["of"] = " and ".join(p.name for p in beside)
        found[point.name] = decisive.model_copy(update=change)
    return found


def _source(points: Sequence[PointReport], row: JudgedPoint) -> SourceReport:
    """Return the source whose values a judged point stands on, its own or the mirrored point's."""
    name = row.of if row.basis == "mirrored" else row.point
    point = next(point for point in points if point.name == name)
    return next(source for source in point.sources if source.decides)


def _largest(first: SourceReport, second: SourceReport) -> SourceReport:
    """Return a source with the larger value of each criterion; one that either lacks stays missing."""
    others = {value.id: value for value in second.values}
    values = []
    for value in first.values:
        other = others.get(value.id)
        if other is None or value.value is None or other.value is None or other.unit != value.unit:
            values.append(
                value.model_copy(update={"value": None, "coded_reason": Reason.of("neighbour-without-value")})
            )
        else:
            values.append(value if value.value >= other.value else other)
    why = first if first.reason or first.coded_reason else second
    update = {"values": values, "decides": True, "usable": first.usable and second.usable}
    return first.model_copy(update=update | {"reason": why.reason, "coded_reason": why.coded_reason})


_ORDER: dict[Verdict | None, int] = {"error": 4, "fail": 3, "conditional": 2, "pass": 1}


def _badness(row: JudgedPoint) -> tuple[float, float]:
    """Rank a judged point: what was judged before what was not, then the worse before the better."""
    if row.maximum:
        lost = 1.0 - (row.points or 0.0) / row.maximum
        return (-1.0 if row.basis == "none" else lost, row.percent or 0.0)
    return (float(_ORDER.get(row.verdict, 0)), row.percent or 0.0)


def _verdict(
    terms: SchemeTerms, judged: Sequence[JudgedPoint], total: float | None, maximum: float | None
) -> Verdict | None:
    if terms.kind != "points":
        return worst(row.verdict or "not evaluated" for row in judged)
    if terms.at_least is None or total is None or maximum is None:
        return None
    if total >= terms.at_least:
        return "pass"
    missing = sum(row.basis == "none" or not row.criteria for row in judged)
    possible = total + maximum * missing / len(judged)
    return "not evaluated" if missing and possible >= terms.at_least else "fail"


_RESTS_ON = {
    "finite elements": "point-rests-on-finite-elements",
    "lumped": "point-rests-on-lumped",
    "predicted": "point-rests-on-prediction",
}
_STANDS_FOR = {"mirrored": "other-side-stands", "neighbour": "neighbour-stands"}


def _remarks(judged: Sequence[JudgedPoint]) -> list[Reason]:
    """Say what the judgement rests on beside measured values."""
    said = []
    for kind, code in _RESTS_ON.items():
        names = [row.point for row in judged if row.source == kind and row.basis == "own"]
        if names:
            said.append(Reason.of(code, points=names))
    for basis, code in _STANDS_FOR.items():
        pairs = [Reason.of("point-of", point=row.point, other=row.of) for row in judged if row.basis == basis]
        if pairs:
            said.append(Reason.of(code, points=pairs))
    names = [row.point for row in judged if row.basis == "none"]
    if names:
        said.append(Reason.of("points-not-known", points=names))
    return said
