"""The figures of a study: tornado, scatter, trade-off. Drawn like the certificates' figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.number_format import plain, signed_significant
from certkit.reporting.palette import ACCENT, GRID, INK, LINE, MUTED, PENS
from certkit.reporting.scales import Scale, span, ticks
from certkit.reporting.svg import Drawing, label, number, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

WIDTH = 640.0
BAR = 16.0
NAMES = 250.0
FIGURES = 70.0  # room for the numbers at the right


def tornado(rows: Sequence[tuple[str, float, float | None, float | None]], title: str, below: str) -> Drawing:
    """Draw one bar a parameter from zero to its effect, the longest on top, with its interval as a whisker.

    Parameters
    ----------
    rows : sequence of (name, effect, lower, upper)
        Lower and upper end of the whisker; None leaves it out.
    title, below : str
        Words at the head and below the axis.
    """
    rows = sorted(rows, key=lambda row: -abs(row[1]))
    known = [value for row in rows for value in (0.0, *row[1:]) if value is not None]
    low, high = span(known)
    scale = Scale(low, high, NAMES, WIDTH - FIGURES)
    height = 24 + len(rows) * (BAR + 8) + 34
    bottom = height - 34
    parts = [
        tag("line", x1=scale(value), x2=scale(value), y1=16.0, y2=bottom, stroke=GRID)
        + label(scale(value), bottom + 14, plain(value), text_anchor="middle", fill=MUTED)
        for value in ticks(low, high)
    ]
    for index, (name, effect, lower, upper) in enumerate(rows):
        top = 20 + index * (BAR + 8)
        left, right = sorted((scale(0.0), scale(effect)))
        pen = PENS[0] if effect >= 0 else PENS[1]
        parts.append(label(NAMES - 10, top + 12, name, text_anchor="end"))
        parts.append(tag("rect", x=left, y=top, width=right - left, height=BAR, fill=pen.colour))
        if lower is not None and upper is not None:
            middle = top + BAR / 2
            parts.append(
                tag(
                    "line",
                    x1=scale(lower),
                    x2=scale(upper),
                    y1=middle,
                    y2=middle,
                    stroke=INK,
                    stroke_width=1.5,
                )
            )
        parts.append(label(WIDTH - 12, top + 12, signed_significant(effect, 3), text_anchor="end", fill=INK))
    parts.append(tag("line", x1=scale(0.0), x2=scale(0.0), y1=14.0, y2=bottom, stroke=INK))
    parts.append(label((NAMES + WIDTH - FIGURES) / 2, height - 4, below, text_anchor="middle"))
    return Drawing(WIDTH, height, "".join(parts), title)


def dots(
    x: Sequence[float],
    y: Sequence[float],
    title: str,
    names: tuple[str, str],
    line: Sequence[tuple[float, float]] = (),
) -> Drawing:
    """Draw a cloud of runs, and a line through some of them.

    Parameters
    ----------
    x, y : sequence of float
        Finite values.
    title : str
    names : (str, str)
        Of the axes, with their units.
    line : sequence of (float, float)
        Joined in order; none when empty.
    """
    width, height, left, top, bottom = 300.0, 220.0, 52.0, 22.0, 182.0
    across = Scale(*span([*x, *(a for a, _ in line)]), left, width - 8)
    up = Scale(*span([*y, *(b for _, b in line)]), bottom, top)
    parts = [
        tag("line", x1=across(v), x2=across(v), y1=top, y2=bottom, stroke=GRID)
        + label(across(v), bottom + 14, plain(v), text_anchor="middle", fill=MUTED, font_size="10")
        for v in ticks(across.low, across.high, 5)
    ]
    parts += [
        tag("line", x1=left, x2=width - 8, y1=up(v), y2=up(v), stroke=GRID)
        + label(left - 5, up(v) + 3.5, plain(v), text_anchor="end", fill=MUTED, font_size="10")
        for v in ticks(up.low, up.high, 5)
    ]
    parts.append(
        tag("rect", x=left, y=top, width=width - 8 - left, height=bottom - top, fill="none", stroke=LINE)
    )
    parts += [
        tag("circle", cx=across(a), cy=up(b), r=1.8, fill=PENS[0].colour, fill_opacity="0.55")
        for a, b in zip(x, y, strict=True)
    ]
    if line:
        data = "M" + "L".join(f"{number(across(a))} {number(up(b))}" for a, b in line)
        parts.append(tag("path", d=data, fill="none", stroke=ACCENT, stroke_width=1.6))
    parts.append(label((left + width) / 2, bottom + 30, names[0], text_anchor="middle", font_size="10"))
    parts.append(label(left, 14.0, names[1], font_size="10", fill=INK))
    return Drawing(width, height, "".join(parts), title)
