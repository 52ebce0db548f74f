"""The car's front as a slide: native shapes that can be moved, coloured and relabelled."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from certkit.reporting.campaign_view import point_shade
from certkit.reporting.charts.car_front import SHADE
from certkit.reporting.charts.car_outline import EDGE, car_parts, sampled

if TYPE_CHECKING:
    from certkit.documents.campaign_report import CampaignReport, JudgedPoint, JudgedScheme
    from certkit.reporting.slide_canvas import Canvas
    from certkit.reporting.slide_deck import SlideDeck

FORMS = {
    "measured": "OVAL",
    "finite elements": "ROUNDED_RECTANGLE",
    "lumped": "DIAMOND",
    "predicted": "DONUT",
}
"""Shape of a mark by where its values come from; other points' values and unknown ones are rings too."""


LEGEND = "disc: measured; square: finite elements; diamond: lumped simulation; ring: predicted or another's"


def car_slide(deck: SlideDeck, document: CampaignReport, scheme: JudgedScheme) -> None:
    """Add a slide with the car and what one scheme says of each point."""
    car = document.car
    places = {point.name: point for point in document.points}
    canvas = deck.canvas(
        f"{scheme.title}: {car.name} from ahead", (-0.56 * car.width, 0.0), (0.56 * car.width, car.height)
    )
    for part in car_parts(car):
        line = sampled(part.points, closed=bool(part.fill)) if part.smooth else part.points
        canvas.form(line, part.fill, EDGE)
    across = sorted(point.across for point in document.points)
    gaps = [b - a for a, b in pairwise(across) if b > a]
    size = min(90.0, 0.86 * min(gaps, default=90.0))
    for row in scheme.points:
        point = places[row.point]
        _mark(canvas, row, (point.across, point.height), size)
    numbers = "% of the limit" if scheme.kind != "points" else "points"
    canvas.label(f"{LEGEND}; numbers: {numbers}", (0.0, -70.0), "#536070", letters=11)


def _mark(canvas: Canvas, row: JudgedPoint, place: tuple[float, float], size: float) -> None:
    own = row.basis == "own" and row.source is not None
    form = FORMS[row.source] if own and row.source else "DONUT"
    colour = SHADE[point_shade(row)]
    canvas.mark(form, place, size, colour)
    below = "?" if row.percent is None else f"{row.percent:.0f}"
    below = below if row.maximum is None else f"{row.points or 0:.2f}"
    canvas.label(row.point, (place[0], place[1] + 1.0 * size), colour, letters=10)
    canvas.label(below, (place[0], place[1] - 1.0 * size), colour, letters=10)
