"""The last curves of each channel over a legform's tests, so that they can be laid over each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.logbook_overview import CurveOfTest, PastCurves
from certkit.logbooks.logbook_entry import entry_of

if TYPE_CHECKING:
    from collections.abc import Iterable

    from certkit.documents.result import CriterionResult, Result

MOST_TESTS = 10
MOST_POINTS = 150
"""Points of a curve that is one of ten in a small picture."""


def past_curves(results: Iterable[Result]) -> list[PastCurves]:
    """Return the curves, by procedure and criterion in the order of first appearance.

    Parameters
    ----------
    results : iterable of Result
        One legform's tests in the order in which they were done; of each procedure the last `MOST_TESTS` are
        kept. Curves are those that the results draw, filtered for grading.
    """
    rows: dict[tuple[str, str], list[tuple[Result, CriterionResult, CurveOfTest]]] = {}
    for result in results:
        for criterion in result.criteria:
            curve = _curve(result, criterion)
            if curve is not None:
                rows.setdefault((result.procedure, criterion.id), []).append((result, criterion, curve))
    return [_joined(row[-MOST_TESTS:]) for row in rows.values()]


def _joined(row: list[tuple[Result, CriterionResult, CurveOfTest]]) -> PastCurves:
    result, last, _ = row[-1]
    plane = last.curve
    return PastCurves(
        procedure=result.procedure,
        criterion=last.id,
        title=last.title,
        x_title=f"{plane.x_title}, {plane.x_unit}" if plane else "ms",
        unit=plane.y_unit if plane else last.unit,
        lower=last.lower,
        upper=last.upper,
        polygon=plane.polygon if plane else None,
        curves=[curve for _, _, curve in row],
    )


def _curve(result: Result, criterion: CriterionResult) -> CurveOfTest | None:
    """Return the curve that a criterion looks at, thinned with its extremes kept; None without one."""
    entry = entry_of(result, result.id)
    if criterion.curve is not None:
        points = list(criterion.curve.points)
    else:
        curves = result.curves
        series = curves.series.get(criterion.channel) if curves else None
        if curves is None or series is None or series.unit != criterion.unit:
            return None
        points = [
            ((curves.start + index * curves.interval) * 1e3, value)
            for index, value in enumerate(series.values)
        ]
    return CurveOfTest(day=entry.day.isoformat(), number=entry.number, id=result.id, points=_thinned(points))


def _thinned(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    if len(points) <= MOST_POINTS:
        return points
    stride = -(-len(points) // MOST_POINTS)
    heights = [y for _, y in points]
    kept = {*range(0, len(points), stride), len(points) - 1}
    kept |= {heights.index(min(heights)), heights.index(max(heights))}
    return [points[index] for index in sorted(kept)]
