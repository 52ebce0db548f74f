"""A curve the size of a word, with its corridor: one line of the suite's index."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.channel_history import limits_of, peak_of
from certkit.reporting.number_format import verdict_class
from certkit.reporting.scales import Scale, span, thinned
from certkit.reporting.svg import Drawing, path, tag

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult, Result

WIDTH, HEIGHT = 132.0, 34.0


def sparkline(result: Result, criterion: CriterionResult | None) -> Drawing | None:
    """Draw the criterion's curve, over time or in its plane; None where neither was recorded."""
    if criterion is None:
        return None
    if criterion.curve:
        return _draw(list(criterion.curve.points), [], None, criterion)
    if result.curves is None or criterion.channel not in result.curves.series:
        return None
    series = result.curves.series[criterion.channel]
    axis = result.curves.milliseconds
    peak = peak_of(criterion, series, axis)
    points = thinned(list(zip(axis, series.values, strict=False)), 80)
    return _draw(points, limits_of(criterion, peak), peak, criterion)


def _draw(
    points: list[tuple[float, float]],
    limits: list[float],
    peak: tuple[float, float] | None,
    criterion: CriterionResult,
) -> Drawing:
    x = Scale(*span([p[0] for p in points], margin=0.01), 3, WIDTH - 3)
    y = Scale(*span([*(p[1] for p in points), *limits, 0.0]), HEIGHT - 3, 3)
    drawn = ""
    if len(limits) == 2:
        drawn += tag(
            "rect",
            x=0,
            width=WIDTH,
            y=y(limits[1]),
            height=y(limits[0]) - y(limits[1]),
            fill=palette.CORRIDOR,
            class_="corridor",
        )
    elif limits:
        drawn += tag(
            "line",
            x1=0,
            x2=WIDTH,
            y1=y(limits[0]),
            y2=y(limits[0]),
            stroke=palette.CORRIDOR_EDGE,
            class_="limit",
        )
    drawn += tag(
        "path",
        d=path((x(a), y(b)) for a, b in points),
        fill="none",
        stroke=palette.PENS[0].colour,
        stroke_width=1.5,
        class_="curve p0",
    )
    if peak:
        colour = palette.VERDICT[criterion.verdict]
        css = verdict_class(criterion.verdict)
        drawn += tag("circle", cx=x(peak[0]), cy=y(peak[1]), r=2.6, fill=colour, class_=css)
    return Drawing(WIDTH, HEIGHT, drawn, criterion.id, css_class="spark")
