"""The car's front from ahead with its impact points, in the colours of what a scheme says of each."""

from __future__ import annotations

from html import escape
from itertools import pairwise
from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.campaign_view import point_shade
from certkit.reporting.charts.car_outline import car_outline
from certkit.reporting.number_format import plain
from certkit.reporting.scales import Scale, ticks
from certkit.reporting.svg import Drawing, label, path, tag
from certkit.reporting.translated_titles import title_in

if TYPE_CHECKING:
    from certkit.documents.campaign_report import (
        CampaignReport,
        CarFront,
        JudgedPoint,
        JudgedScheme,
        PointReport,
    )
    from certkit.reporting.campaign_view import CampaignView

Attributes = dict[str, float | str | None]
"""Of an element."""

WIDTH = 1000.0
LEG = (75.0, 1003.0)
"""mm above the ground between which a legform of 928 mm hangs in the vehicle test."""

ABOVE = 300.0
"""mm of the car that are seen above the legform: its roof decides nothing."""

SHADE = {
    "s1": "#0a6847",
    "s2": "#4f7a12",
    "s3": "#8a6100",
    "s4": "#a8480f",
    "s5": "#b3261e",
    "none": "#536070",
}
"""Five shades from the best to the worst; each carries white words with a contrast of at least 4.5."""


def car_front(view: CampaignView, scheme: JudgedScheme) -> Drawing:
    """Draw the car and what one scheme says of each of its points.

    Places are mm, positive to the right of the picture. The form of a mark says where its values come from:
    a disc was measured, a square is a finite-element run, a diamond a lumped simulation, a ring a prediction;
    a dashed ring takes another point's values, a small one has none.
    """
    document = view.document
    car = document.car
    half = 0.56 * car.width
    x = Scale(-half, half, 20.0, WIDTH - 20.0)
    step = (WIDTH - 40.0) / (2 * half)
    seen = min(car.height + 40.0, LEG[1] + ABOVE)
    ground = seen * step
    z = Scale(0.0, seen, ground, 0.0)
    drawn = car_outline(car, x, z)
    drawn += _zones(car, x, z, view) + _axis(view, x, ground)
    reports = {point.name: point for point in document.points}
    size = _size(document, step)
    rows = sorted(scheme.points, key=lambda row: reports[row.point].across)
    for row in rows:
        point = reports[row.point]
        top, bottom = z(min(LEG[1], car.height)), z(LEG[0])
        drawn += tag(
            "line",
            x1=x(point.across),
            x2=x(point.across),
            y1=top,
            y2=bottom,
            stroke=SHADE[point_shade(row)],
            stroke_width=max(4.0, 0.45 * size),
            stroke_linecap="round",
            stroke_opacity="0.28",
            class_=f"leg {point_shade(row)}",
        )
    for row in rows:
        drawn += tag(
            "a",
            _mark(row, reports[row.point], x, z, size, view.judged_words(row)),
            href=f"#{view.anchor(row.point)}",
            class_="point",
        )
    said = "; ".join(
        f"{view.t('{point} at {place} mm', point=row.point, place=plain(reports[row.point].across))}: "
        f"{view.judged_words(row)}"
        for row in rows
    )
    title = f"{view.t('{car} from ahead', car=car.name)}, {title_in(scheme.title, view.spoken)}: {said}"
    return Drawing(WIDTH, ground + 46.0, drawn, title, "figure car", "group")


def _size(document: CampaignReport, step: float) -> float:
    """Return the radius of a mark that leaves its neighbours room."""
    places = sorted(point.across for point in document.points)
    gaps = [b - a for a, b in pairwise(places) if b > a]
    return min(24.0, max(7.0, 0.44 * step * min(gaps, default=200.0)))


def _mark(row: JudgedPoint, point: PointReport, x: Scale, z: Scale, size: float, said: str) -> str:
    """Draw the mark with its name, and below it what decides there."""
    a, b = x(point.across), z(point.height)
    shade = point_shade(row)
    inner = tag("title", escape(f"{row.point}: {said}"))
    inner += _form(row, a, b, size, shade)
    hollow = row.basis != "own" or row.source == "predicted"
    inner += label(
        a,
        b + 0.3 * size * 0.6 + 1.0,
        row.point,
        text_anchor="middle",
        font_size=f"{max(7.0, 0.62 * size):.1f}",
        font_weight="600",
        fill=SHADE[shade] if hollow else "#ffffff",
        class_=f"name {shade} {'hollow' if hollow else 'full'}",
    )
    return inner + _words(row, a, b, size)


def _form(row: JudgedPoint, a: float, b: float, size: float, shade: str) -> str:
    colour = SHADE[shade]
    ring: Attributes = {
        "fill": palette.PAPER,
        "stroke": colour,
        "stroke_width": 3.0,
        "class_": f"ring {shade}",
    }
    full: Attributes = {
        "fill": colour,
        "stroke": palette.PAPER,
        "stroke_width": 2.0,
        "class_": f"full {shade}",
    }
    if row.basis in {"mirrored", "neighbour"}:
        return tag("circle", "", cx=a, cy=b, r=size - 1.5, stroke_dasharray="5 4", **ring)
    if row.basis == "none":
        return tag("circle", "", cx=a, cy=b, r=size - 1.5, stroke_dasharray="1.5 4", **ring)
    if row.source == "predicted":
        return tag("circle", "", cx=a, cy=b, r=size - 1.5, **ring)
    if row.source == "lumped":
        reach = 1.28 * size
        corners = [(a, b - reach), (a + reach, b), (a, b + reach), (a - reach, b)]
        return tag("path", "", d=path(corners, closed=True), stroke_linejoin="round", **full)
    if row.source == "finite elements":
        side = 0.92 * size
        return tag("rect", "", x=a - side, y=b - side, width=2 * side, height=2 * side, rx=4.0, **full)
    return tag("circle", "", cx=a, cy=b, r=size, **full)


def _words(row: JudgedPoint, a: float, b: float, size: float) -> str:
    below = b + 1.28 * size + 15.0
    letters = f"{min(13.0, 0.6 * size):.1f}"
    common: Attributes = {"text_anchor": "middle", "font_size": letters, "class_": "mark"}
    if row.basis == "none":
        return label(a, below, "?", **common)
    if row.maximum is not None:
        said = [f"{row.points or 0:.2f}", row.worst]
    else:
        said = [f"{row.percent:.0f} %" if row.percent is not None else "?", row.worst]
    return "".join(label(a, below + 14.0 * line, words, **common) for line, words in enumerate(said) if words)


def _zones(car: CarFront, x: Scale, z: Scale, view: CampaignView) -> str:
    """Hatch the zones of relaxed limits, and mark the test area."""
    drawn = ""
    for low, high in car.zones:
        top, bottom = z(car.bonnet_edge), z(120.0)
        drawn += tag(
            "rect",
            x=x(low),
            y=top,
            width=x(high) - x(low),
            height=bottom - top,
            rx=6.0,
            fill=palette.GUARD,
            fill_opacity="0.45",
            class_="zone",
        )
        middle = (x(low) + x(high)) / 2
        drawn += label(
            middle,
            top - 8.0,
            view.t("relaxed"),
            text_anchor="middle",
            fill=palette.MUTED,
            class_="tick mark",
        )
    for edge in car.test_area or ():
        drawn += tag(
            "line",
            x1=x(edge),
            x2=x(edge),
            y1=z(car.bonnet_edge + 60.0),
            y2=z(0.0) + 6.0,
            stroke=palette.MUTED,
            stroke_dasharray="6 5",
            class_="zero",
        )
    return drawn


def _axis(view: CampaignView, x: Scale, ground: float) -> str:
    """Draw the ground and the scale across the car."""
    car = view.document.car
    drawn = tag("line", x1=x.start, x2=x.end, y1=ground, y2=ground, stroke=palette.MUTED, class_="zero")
    for value in ticks(-0.5 * car.width, 0.5 * car.width, 9):
        drawn += tag(
            "line", x1=x(value), x2=x(value), y1=ground, y2=ground + 6, stroke=palette.MUTED, class_="zero"
        )
        drawn += label(
            x(value),
            ground + 21,
            plain(value),
            text_anchor="middle",
            font_size="13",
            fill=palette.MUTED,
            class_="tick",
        )
    words = view.t("mm from the middle, seen from ahead")
    if car.test_area is not None:
        low, high = map(plain, car.test_area)
        words += view.t("; test area {low} to {high} mm", low=low, high=high)
    return drawn + label(
        WIDTH / 2, ground + 40, words, text_anchor="middle", font_size="13", fill=palette.MUTED, class_="tick"
    )
