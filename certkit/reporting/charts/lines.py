"""Several curves in one plot, told apart by colour and dash."""

from __future__ import annotations

from collections.abc import Sequence

from certkit.reporting import palette
from certkit.reporting.charts.axes import Frame
from certkit.reporting.scales import span, traced
from certkit.reporting.svg import Drawing, label, path, tag

Line = tuple[str, Sequence[float], Sequence[float]]
"""Name, abscissae, ordinates."""


def lines_chart(
    lines: Sequence[Line], title: str, x_title: str, unit: str, *, width: float = 740, height: float = 230
) -> Drawing:
    """Draw lines with a legend to the right of the title.

    Parameters
    ----------
    lines : sequence of (name, x, y)
        At most seven are told apart by pen; more repeat.
    title, x_title, unit : str
        Words at the plot's head, at its abscissa and the ordinate's unit.
    width, height : float
        Size in pixels.
    """
    rows = _legend(lines, title, width)
    x = span([v for _, xs, _ in lines for v in xs], margin=0)
    y = span([0.0, *(v for _, _, ys in lines for v in ys)])
    above = 12.0 + 16 * (1 + max(row for row, _ in rows))
    below = 22.0 if len(x_title) < 4 else 36.0
    frame = Frame.around(x, y, width=width, height=height, above=above, below=below)
    drawn = frame.axes(title, x_title, unit)
    for index, ((name, xs, ys), (row, place)) in enumerate(zip(lines, rows, strict=True)):
        css = f"curve p{index % len(palette.PENS)}"
        pen = palette.PENS[index % len(palette.PENS)]
        points = traced(list(zip(xs, ys, strict=True)), 90)
        data = path(frame.place(a, b) for a, b in points)
        drawn += tag(
            "path",
            d=data,
            fill="none",
            stroke=pen.colour,
            stroke_width=1.6,
            stroke_dasharray=pen.dash,
            class_=css,
        )
        line = 10.0 + 16 * row
        drawn += tag(
            "line",
            x1=place,
            x2=place + 22,
            y1=line,
            y2=line,
            stroke=pen.colour,
            stroke_width=2,
            stroke_dasharray=pen.dash,
            class_=css,
        )
        drawn += label(place + 27, line + 4, name, class_="key")
    return Drawing(width, height, drawn, f"{title} in {unit}: " + ", ".join(name for name, _, _ in lines))


def _legend(lines: Sequence[Line], title: str, width: float) -> list[tuple[int, float]]:
    """Return the row and the place of each key, leaving room for the plot's title and its unit."""
    first = 6 + 6.6 * len(title) + 18
    row, place = 0, first
    found: list[tuple[int, float]] = []
    for name, _, _ in lines:
        length = 27 + 6.2 * len(name) + 14
        if place + length > width - 40:
            row, place = row + 1, first
        found.append((row, place))
        place += length
    return found
