"""Peaks beside each other, channel by channel: test, this simulation and the published one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.charts.axes import Frame
from certkit.reporting.language import english
from certkit.reporting.number_format import fixed
from certkit.reporting.svg import Drawing, label, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Comparison, Result
    from certkit.reporting.language import Translate

WIDTH, HEIGHT = 740.0, 230.0

_FILLS = (
    ("test", "#3a3f45", "b0"),
    ("simulation", "#0072b2", "b1"),
    ("published simulation", "#9cc6e2", "b2"),
)


def draw(result: Result, names: Sequence[str]) -> Drawing | None:
    """Draw the figure of a result; None where it was compared with nothing."""
    del names
    comparison = result.comparison
    return errors_chart(comparison) if comparison and comparison.rows else None


def errors_chart(comparison: Comparison, *, t: Translate = english) -> Drawing:
    """Draw grouped bars with this simulation's error above each group."""
    rows = comparison.rows
    values = [v for r in rows for v in (r.test, r.simulation, r.published) if v is not None]
    low, high = min(0.0, *values), max(0.0, *values)
    room = (high - low) * 0.14 or 1.0
    frame = Frame.around(
        (0, len(rows)), (low - (room if low < 0 else 0), high + room), width=WIDTH, height=HEIGHT
    )
    drawn = frame.axes(t("Peaks"), "", rows[0].unit if rows else "", numbered=False)
    published = any(r.published is not None for r in rows)
    shown = _FILLS if published else _FILLS[:2]
    bar = 0.72 / len(shown)
    for index, row in enumerate(rows):
        heights = (row.test, row.simulation, row.published)
        for place, (_, fill, css) in enumerate(shown):
            value = heights[place]
            if value is None:
                continue
            side = frame.x(index + 0.14 + bar * place)
            top, bottom = frame.y(max(value, 0)), frame.y(min(value, 0))
            drawn += tag(
                "rect",
                x=side,
                y=top,
                width=frame.x(bar) - frame.x(0) - 1.5,
                height=max(bottom - top, 0.5),
                fill=fill,
                class_=css,
            )
        middle = frame.x(index + 0.5)
        top = frame.y(max(0.0, *(v for v in heights if v is not None)))
        sign = "+" if row.error_percent > 0 else ""
        drawn += label(
            middle, top - 5, f"{sign}{fixed(row.error_percent, 1)} %", text_anchor="middle", class_="mark"
        )
        drawn += label(middle, frame.bottom + 15, row.channel, text_anchor="middle", font_weight="600")
    left = max(62.0, 12 + 8.0 * len(t("Peaks")))
    for word, fill, css in shown:
        name = t(word)
        drawn += tag("rect", x=left, y=5, width=11, height=11, fill=fill, class_=css)
        drawn += label(left + 16, 14, name, class_="key")
        left += 16 + 6.4 * len(name) + 16
    return Drawing(WIDTH, HEIGHT, drawn, t("Peaks of test and simulation, channel by channel"))
