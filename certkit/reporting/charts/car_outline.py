"""The outline of a car from ahead, in the proportions of the one that is tested: a mere picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.svg import number, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.campaign_report import CarFront
    from certkit.reporting.scales import Scale

Place = tuple[float, float]
BODY, GLASS, DARK, LAMP, EDGE = "#dfe4ea", "#c3ccd6", "#aab4bf", "#f7f9fb", "#8793a0"


def car_outline(car: CarFront, x: Scale, z: Scale) -> str:
    """Draw body, windscreen, lamps, grille, bumper and wheels, symmetric to the middle.

    Parameters
    ----------
    car : CarFront
        Width, height, bonnet edge and bumper, mm.
    x, z : Scale
        From mm across and above the ground to the picture.
    """
    w, h, edge, bumper = car.width / 2, car.height, car.bonnet_edge, car.bumper

    def shape(half: Sequence[Place], fill: str, css: str) -> str:
        """Draw a form given by its right half, from its top middle to its bottom middle."""
        right = [(x(a * w), z(b)) for a, b in half]
        left = [(x(-a * w), z(b)) for a, b in reversed(half) if a > 0]
        return tag("path", d=smooth([*right, *left]), fill=fill, stroke=EDGE, stroke_width=1.5, class_=css)

    drawn = ""
    for side in (-1, 1):
        inner, outer = sorted((x(side * 0.70 * w), x(side * 0.93 * w)))
        drawn += tag(
            "rect",
            x=inner,
            y=z(340.0),
            width=outer - inner,
            height=z(0.0) - z(340.0),
            rx=10.0,
            fill="#5b6672",
            class_="car-wheel",
        )
        a, b = x(side * 1.0 * w), z(edge + 0.36 * (h - edge))
        drawn += tag(
            "ellipse",
            cx=a,
            cy=b,
            rx=0.075 * (x(w) - x(0)),
            ry=0.05 * (x(w) - x(0)),
            fill=DARK,
            class_="car-dark",
        )
    roof = edge + 0.42 * (h - edge)
    body = [
        (0.0, h),
        (0.34, h - 6),
        (0.60, h - 45),
        (0.74, edge + 0.62 * (h - edge)),
        (0.88, roof - 60),
        (0.965, edge + 40),
        (1.0, edge - 110),
        (1.0, bumper - 20),
        (0.985, 300),
        (0.93, 200),
        (0.7, 168),
        (0.0, 160),
    ]
    drawn += shape(body, BODY, "car-body")
    screen = [
        (0.0, h - 70),
        (0.34, h - 76),
        (0.56, h - 108),
        (0.68, edge + 0.58 * (h - edge)),
        (0.79, roof - 75),
        (0.40, roof - 48),
        (0.0, roof - 42),
    ]
    drawn += shape(screen, GLASS, "car-glass")
    bonnet = [(0.0, edge + 12), (0.45, edge + 4), (0.80, edge - 40), (0.93, edge - 95)]
    line = [(x(-a * w), z(b)) for a, b in reversed(bonnet)] + [(x(a * w), z(b)) for a, b in bonnet[1:]]
    drawn += tag(
        "path", d=smooth(line, closed=False), fill="none", stroke=EDGE, stroke_width=1.5, class_="car-line"
    )
    for side in (-1, 1):
        lamp = [
            (0.56, edge - 62),
            (0.74, edge - 70),
            (0.93, edge - 108),
            (0.955, edge - 165),
            (0.80, edge - 168),
            (0.62, edge - 128),
        ]
        drawn += tag(
            "path",
            d=smooth([(x(side * a * w), z(b)) for a, b in lamp]),
            fill=LAMP,
            stroke=EDGE,
            stroke_width=1.5,
            class_="car-lamp",
        )
    top, foot = edge - 70, bumper + 75
    if top > foot:
        grille = [(0.0, top), (0.40, top - 4), (0.45, top - 24), (0.40, foot + 4), (0.0, foot)]
        drawn += shape(grille, DARK, "car-dark")
    band = [
        (0.0, bumper + 62),
        (0.62, bumper + 58),
        (0.95, bumper + 34),
        (0.965, bumper - 30),
        (0.60, bumper - 60),
        (0.0, bumper - 66),
    ]
    drawn += shape(band, BODY, "car-body")
    intake = [(0.0, bumper - 110), (0.56, bumper - 112), (0.64, bumper - 150), (0.56, 215), (0.0, 212)]
    return drawn + shape(intake, DARK, "car-dark")


def smooth(points: Sequence[Place], *, closed: bool = True) -> str:
    """Return path data of a smooth line through points (Catmull and Rom's spline as Bézier curves)."""
    count = len(points)

    def at(index: int) -> Place:
        return points[index % count] if closed else points[min(max(index, 0), count - 1)]

    data = [f"M{number(points[0][0])} {number(points[0][1])}"]
    for i in range(count if closed else count - 1):
        p0, p1, p2, p3 = at(i - 1), at(i), at(i + 1), at(i + 2)
        first = (p1[0] + (p2[0] - p0[0]) / 9, p1[1] + (p2[1] - p0[1]) / 9)
        second = (p2[0] - (p3[0] - p1[0]) / 9, p2[1] - (p3[1] - p1[1]) / 9)
        data.append("C" + " ".join(f"{number(a)} {number(b)}" for a, b in (first, second, p2)))
    return "".join(data) + ("z" if closed else "")
