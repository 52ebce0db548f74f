"""Several channels in one plot, told apart by colour and dash; used for energies and overlays."""

from __future__ import annotations

from collections.abc import Sequence

from certkit.reporting import palette
from certkit.reporting.charts.frame import Frame
from certkit.reporting.scales import span, thinned
from certkit.reporting.svg import label, path, picture, tag

Line = tuple[str, Sequence[float], Sequence[float]]
"""Name, abscissae, ordinates."""


def lines_chart(
    lines: Sequence[Line], title: str, x_title: str, unit: str, *, width: float = 740, height: float = 230
) -> str:
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
    x = span([v for _, xs, _ in lines for v in xs], margin=0)
    y = span([0.0, *(v for _, _, ys in lines for v in ys)])
    frame = Frame.around(x, y, width=width, height=height)
    drawn = frame.axes(title, x_title, unit)
    place = 6 + 6.6 * len(title) + 18
    for index, (name, xs, ys) in enumerate(lines):
        pen = palette.PENS[index % len(palette.PENS)]
        css = f"curve p{index % len(palette.PENS)}"
        points = thinned(list(zip(xs, ys, strict=True)))
        drawn += tag(
            "path",
            d=path(frame.place(a, b) for a, b in points),
            fill="none",
            stroke=pen.colour,
            stroke_width=1.6,
            stroke_dasharray=pen.dash,
            class_=css,
        )
        drawn += tag(
            "line",
            x1=place,
            x2=place + 22,
            y1=10,
            y2=10,
            stroke=pen.colour,
            stroke_width=2,
            stroke_dasharray=pen.dash,
            class_=css,
        )
        drawn += label(place + 27, 14, name, class_="key")
        place += 27 + 6.2 * len(name) + 14
    return picture(width, height, drawn, f"{title} in {unit}: " + ", ".join(name for name, _, _ in lines))
