"""The curves of a channel over a legform's last tests, laid over each other in its corridor."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.axes import Frame
from certkit.reporting.number_format import named
from certkit.reporting.scales import span
from certkit.reporting.svg import Drawing, label, path, tag
from certkit.reporting.translated_titles import title_in

if TYPE_CHECKING:
    from certkit.documents.logbook_overview import PastCurves
    from certkit.reporting.language import Language

WIDTH, HEIGHT = 360.0, 210.0


def past_curves_chart(past: PastCurves, spoken: Language) -> Drawing:
    """Draw them: the last test in colour, those before it grey and paler the older they are."""
    points = [point for curve in past.curves for point in curve.points]
    limits = [limit for limit in (past.lower, past.upper) if limit is not None] if not past.polygon else []
    x = span([*(p[0] for p in points), *(p[0] for p in past.polygon or ())], margin=0)
    y = span([0.0, *(p[1] for p in points), *(p[1] for p in past.polygon or ()), *limits])
    frame = Frame.around(x, y, width=WIDTH, height=HEIGHT, below=36)
    title = f"{past.procedure}: {named(past.criterion, title_in(past.title, spoken))}"
    drawn = _corridor(past, limits, frame)
    name, comma, unit = past.x_title.rpartition(", ")
    drawn += frame.axes(title, f"{title_in(name, spoken)}{comma}{unit}", past.unit)
    count = len(past.curves)
    for number, curve in enumerate(past.curves, 1):
        last = number == count
        drawn += tag(
            "path",
            d=path(frame.place(*point) for point in curve.points),
            fill="none",
            stroke=palette.PENS[0].colour if last else palette.MUTED,
            stroke_width=1.8 if last else 0.9,
            stroke_opacity="1" if last else f"{0.3 + 0.5 * number / count:.2f}",
            class_="curve p0" if last else "zero",
        )
    said = spoken.word(
        "1 test, {first}" if count == 1 else "{count} tests, {first} to {last}",
        count=count,
        first=past.curves[0].day,
        last=past.curves[-1].day,
    )
    drawn += label(frame.right, HEIGHT - 4, said, text_anchor="end", fill=palette.MUTED, class_="tick")
    return Drawing(
        WIDTH, HEIGHT, drawn, f"{title}, {past.unit}: {said}; {spoken.word('the last one in colour')}"
    )


def _corridor(past: PastCurves, limits: list[float], frame: Frame) -> str:
    """Draw the corridor of the largest value, or the area of the curve."""
    if past.polygon:
        return frame.area(past.polygon)
    return frame.corridor(*limits) if len(limits) == 2 else ""
