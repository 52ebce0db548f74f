"""A curve of one channel over another, with the polygon it has to stay in where there is one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.axes import Frame
from certkit.reporting.charts.chosen import chosen
from certkit.reporting.charts.grid import together
from certkit.reporting.language import english
from certkit.reporting.scales import span
from certkit.reporting.svg import Drawing, label, path, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CurveInPlane, Result
    from certkit.reporting.language import Translate


def draw(result: Result, names: Sequence[str]) -> Drawing | None:
    """Draw the curves of a result's criteria, all or those that are named."""
    curves = {c.id: (c.curve, c.title) for c in result.criteria if c.curve}
    drawings = [plane_chart(*curves[name]) for name in chosen(names, curves)]
    return together(drawings, f"Curves of {result.title}")


def plane_chart(
    curve: CurveInPlane, title: str, *, width: float = 360, height: float = 240, t: Translate = english
) -> Drawing:
    """Draw it."""
    everything = [*curve.points, *(curve.polygon or [])]
    x = span([0.0, *(p[0] for p in everything)], margin=0.05)
    y = span([0.0, *(p[1] for p in everything)], margin=0.05)
    frame = Frame.around(x, y, width=width, height=height, below=36)
    drawn = ""
    if curve.polygon:
        drawn += frame.area(curve.polygon)
    ordinate = f"{curve.y_title}, {curve.y_unit}"
    if 6.6 * (len(title) + len(ordinate)) > width - 12:
        ordinate = curve.y_unit  # beside a long title there is room for the unit alone
    drawn += frame.axes(title, f"{curve.x_title}, {curve.x_unit}", ordinate)
    drawn += tag(
        "path",
        d=path(frame.place(*p) for p in curve.points),
        fill="none",
        stroke=palette.PENS[0].colour,
        stroke_width=1.8,
        stroke_linejoin="round",
        class_="curve p0",
    )
    drawn += "".join(
        tag("circle", cx=frame.x(a), cy=frame.y(b), r=1.9, fill=palette.PENS[0].colour, class_="dot p0")
        for a, b in (curve.points if len(curve.points) <= 60 else [])
    )
    if not curve.polygon:
        # A curve that runs low on the right leaves its room above.
        lowest = max((frame.y(b) for a, b in curve.points if 2 * a > x[0] + x[1]), default=frame.top)
        height = frame.top + 12 if lowest > frame.bottom - 30 else frame.bottom - 18
        zero = frame.y(0.0)
        if height - 11 < zero < height + 4:  # the zero line would strike it through
            height = zero + 14 if zero + 18 < frame.bottom else zero - 6
        drawn += label(
            frame.right - 4,
            height,
            t("no corridor known: shown, not graded"),
            text_anchor="end",
            fill=palette.MUTED,
            class_="tick",
        )
    words = t(
        "{ordinate} in {unit} over {abscissa} in {other}",
        ordinate=curve.y_title,
        unit=curve.y_unit,
        abscissa=curve.x_title,
        other=curve.x_unit,
    )
    return Drawing(width, height, drawn, words)
