"""Several curves in one plot, told apart by colour and dash."""

from __future__ import annotations

from collections.abc import Sequence

from certkit.reporting import palette
from certkit.reporting.charts.axes import Frame
from certkit.reporting.scales import span, traced
from certkit.reporting.svg import Drawing, label, letters, path, tag

Line = tuple[str, Sequence[float], Sequence[float]]
"""Name, abscissae, ordinates."""


def lines_chart(  # noqa: PLR0913  # words, lines, and what stands beside them
    lines: Sequence[Line],
    title: str,
    x_title: str,
    unit: str,
    *,
    width: float = 740,
    height: float = 230,
    pens: Sequence[palette.Pen] = palette.GROUP_PENS,
    marks: Sequence[tuple[int, float, float]] = (),
    beyond: float | None = None,
    most: int = 90,
) -> Drawing:
    """Draw lines with a legend to the right of the title.

    Parameters
    ----------
    lines : sequence of (name, x, y)
        All are told apart, by colour or dash; one without a name has no key.
    title, x_title, unit : str
        Words at the plot's head, at its abscissa and the ordinate's unit.
    width, height : float
        Size in pixels.
    pens : sequence of Pen
        One a line, where the usual ones do not serve.
    marks : sequence of (line, x, y)
        Dots, such as at a line's peak.
    beyond : float, optional
        The plot is shaded from this abscissa on.
    most : int
        About how many points of each line are drawn.
    """
    rows = _legend(lines, title, width)
    x = span([v for _, xs, _ in lines for v in xs], margin=0)
    y = span([0.0, *(v for _, _, ys in lines for v in ys)])
    above = 12.0 + 16 * (1 + max(row for row, _ in rows))
    below = 22.0 if len(x_title) < 4 else 36.0
    frame = Frame.around(x, y, width=width, height=height, above=above, below=below)
    drawn = ""
    if beyond is not None and beyond < x[1]:
        left = frame.x(max(beyond, x[0]))
        wide, high = frame.right - left, frame.bottom - frame.top
        fill = palette.GUARD
        drawn += tag("rect", x=left, y=frame.top, width=wide, height=high, fill=fill, class_="guard")
    drawn += frame.axes(title, x_title, unit)
    for index, ((name, xs, ys), (row, place)) in enumerate(zip(lines, rows, strict=True)):
        pen = pens[index % len(pens)]
        css = f"curve {_css(pen)}"
        points = traced(list(zip(xs, ys, strict=True)), most)
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
        if not name:
            continue
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
    for index, a, b in marks:
        pen = pens[index % len(pens)]
        at = frame.place(a, b)
        drawn += tag("circle", cx=at[0], cy=at[1], r=3.4, fill=pen.colour, class_=f"dot {_css(pen)}")
    names = ", ".join(name for name, _, _ in lines)
    return Drawing(width, height, drawn, f"{title}, {unit}: {names}" if names else f"{title}, {unit}")


def _css(pen: palette.Pen) -> str:
    """Return the class by which the page's themes know a pen's colour."""
    return next((f"p{k}" for k, each in enumerate(palette.PENS) if each.colour == pen.colour), "p0")


def _legend(lines: Sequence[Line], title: str, width: float) -> list[tuple[int, float]]:
    """Return the row and the place of each key, leaving room for the plot's title and its unit."""
    first, row = 6 + 6.6 * letters(title) + 18, 0
    longest = max(27 + 6.2 * letters(name) + 14 for name, _, _ in lines)
    if first + longest > width - 40:  # no room beside a long title: below it
        first, row = 6.0, 1
    place = first
    found: list[tuple[int, float]] = []
    for name, _, _ in lines:
        length = 27 + 6.2 * letters(name) + 14
        if place + length > width - 40:
            row, place = row + 1, first
        found.append((row, place))
        place += length
    return found


def pressed(xs: Sequence[float], ys: Sequence[float]) -> tuple[list[float], list[float]]:
    """Leave out of a force over shortening how two groups fly apart: far, and without a force to draw."""
    least = 0.01 * max((abs(y) for y in ys), default=0.0)
    kept = [(x, y) for x, y in zip(xs, ys, strict=True) if x >= 0 or abs(y) > least]
    kept = kept or list(zip(xs, ys, strict=True))[:1]
    return [x for x, _ in kept], [y for _, y in kept]
