"""The overview of legforms as a page with pictures, from the overview documents alone."""

from __future__ import annotations

import re
from datetime import date
from typing import TYPE_CHECKING

from certkit.files import write_whole
from certkit.reporting import palette
from certkit.reporting.charts.past_curves_chart import past_curves_chart
from certkit.reporting.language import ENGLISH, language, worded
from certkit.reporting.number_format import named, plain
from certkit.reporting.scales import Scale, span, ticks
from certkit.reporting.static_page import static_page
from certkit.reporting.svg import Drawing, label, path, tag
from certkit.reporting.translated_titles import title_in

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from pathlib import Path

    from certkit.documents.logbook_overview import LegOverview, Trend
    from certkit.reporting.language import Language

WIDTH, HEIGHT = 360.0, 190.0


def render_logbook(
    leg: LegOverview, out: Path, formats: Collection[str], *, spoken: str = ENGLISH
) -> list[Path]:
    """Write `logbook-SERIAL.html` when it is wanted.

    Returns
    -------
    list of Path
        What was written.
    """
    if "html" not in formats:
        return []
    written = out / f"logbook-{re.sub(r'[^A-Za-z0-9.-]+', '-', leg.serial).strip('-.')}.html"
    write_whole(written, logbook_page([leg], spoken))
    return [written]


def logbook_page(legs: Sequence[LegOverview], spoken: str = ENGLISH) -> str:
    """Return one page with a section for each legform, in a language."""
    words = language(spoken)
    title = (
        words.word("Logbook of legform {serial}", serial=legs[0].serial)
        if len(legs) == 1
        else words.word("Logbook of {count} legforms", count=len(legs))
    )
    if spoken != ENGLISH:
        legs = [worded(leg, spoken) for leg in legs]
    shown = [
        (
            leg,
            [(trend, control_chart(trend, words) if trend.count > 1 else "") for trend in leg.trends],
            [past_curves_chart(past, words) for past in leg.curves],
        )
        for leg in legs
    ]
    return static_page("logbook.html.j2", title, spoken=spoken, legs=shown)


def control_chart(trend: Trend, spoken: Language) -> Drawing:
    """Draw a channel's values over the tests, with corridor, control limits and drift."""
    values = span([*trend.values, trend.lower, trend.upper, trend.control_lower, trend.control_upper])
    days = [float(date.fromisoformat(day).toordinal()) for day in trend.days]
    first, last = span(days, margin=0.04)
    x, y = Scale(first, last, 46, WIDTH - 12), Scale(*values, HEIGHT - 30, 26)
    title = f"{trend.procedure}: {named(trend.criterion, title_in(trend.title, spoken))}"
    drawn = _corridor(trend, x, y)
    for value in ticks(*values, 5):
        drawn += tag(
            "line", x1=x.start, x2=x.end, y1=y(value), y2=y(value), stroke=palette.GRID, class_="grid"
        )
        drawn += label(
            x.start - 6, y(value) + 3.6, plain(value), text_anchor="end", fill=palette.MUTED, class_="tick"
        )
    drawn += _limits(trend, x, y)
    drawn += _drift(trend, days, x, y)
    drawn += tag(
        "path",
        d=path((x(day), y(value)) for day, value in zip(days, trend.values, strict=True)),
        fill="none",
        stroke=palette.PENS[0].colour,
        stroke_width=1.2,
        class_="curve p0",
    )
    for place, (day, value) in enumerate(zip(days, trend.values, strict=True), 1):
        outside = place in trend.outside_control
        drawn += tag(
            "circle",
            cx=x(day),
            cy=y(value),
            r=4.5 if outside else 2.6,
            fill=palette.VERDICT["fail"] if outside else palette.PENS[0].colour,
            class_="outside" if outside else "dot p0",
        )
    drawn += label(6, 14, title, font_weight="600", class_="title")
    drawn += label(x.end, 14, trend.unit, text_anchor="end", fill=palette.MUTED, class_="tick unit")
    for edge, written, anchor in ((x.start, trend.days[0], "start"), (x.end, trend.days[-1], "end")):
        drawn += label(edge, HEIGHT - 10, written, text_anchor=anchor, fill=palette.MUTED, class_="tick")
    said = spoken.word(
        "{count} values, mean {mean} {unit}",
        count=trend.count,
        mean=plain(trend.mean, 4),
        unit=trend.unit,
    )
    alternative = f"{title}: {said}; {trend.remark}"
    return Drawing(WIDTH, HEIGHT, drawn, alternative)


def _corridor(trend: Trend, x: Scale, y: Scale) -> str:
    """Shade the corridor; a side without a limit runs to the edge."""
    if trend.lower is None and trend.upper is None:
        return ""
    top = y.end if trend.upper is None else y(trend.upper)
    bottom = y.start if trend.lower is None else y(trend.lower)
    return tag(
        "rect",
        x=x.start,
        y=top,
        width=x.end - x.start,
        height=bottom - top,
        fill=palette.CORRIDOR,
        class_="corridor",
    )


def _limits(trend: Trend, x: Scale, y: Scale) -> str:
    """Draw mean and control limits."""
    drawn = tag(
        "line", x1=x.start, x2=x.end, y1=y(trend.mean), y2=y(trend.mean), stroke=palette.MUTED, class_="zero"
    )
    for limit in (trend.control_lower, trend.control_upper):
        if limit is not None:
            drawn += tag(
                "line",
                x1=x.start,
                x2=x.end,
                y1=y(limit),
                y2=y(limit),
                stroke=palette.MUTED,
                stroke_dasharray="4 3",
                class_="zero",
            )
    return drawn


def _drift(trend: Trend, days: Sequence[float], x: Scale, y: Scale) -> str:
    """Draw the fitted line where there is a drift."""
    if not trend.drifts or trend.slope_per_year is None:
        return ""
    middle = sum(days) / len(days)
    ends = [
        (x(day), y(trend.mean + trend.slope_per_year / 365.25 * (day - middle)))
        for day in (days[0], days[-1])
    ]
    pen = palette.PENS[1]
    return tag(
        "path",
        d=path(ends),
        fill="none",
        stroke=pen.colour,
        stroke_width=2,
        stroke_dasharray=pen.dash,
        class_="curve p1",
    )
