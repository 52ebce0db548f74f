"""The outline of a car from ahead, in the proportions of the one that is tested: a mere picture."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting.svg import number, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.campaign_report import CarFront
    from certkit.reporting.scales import Scale

Place = tuple[float, float]
BODY, GLASS, DARK, LAMP, EDGE, WHEEL = "#dfe4ea", "#c3ccd6", "#aab4bf", "#f7f9fb", "#8793a0", "#5b6672"


class CarPart(Struct, frozen=True):
    """A form of the picture.

    Parameters
    ----------
    css : str
        What style sheets know it by.
    fill : str
        Its colour; empty for a line.
    points : list of (float, float)
        mm across and above the ground.
    smooth : bool
        Whether the line through the points is a smooth one.
    """

    css: str
    fill: str
    points: list[Place]
    smooth: bool = True


def car_parts(car: CarFront) -> list[CarPart]:
    """Return the forms from back to front: wheels, mirrors, body, windscreen, lamps, grille and bumper."""
    w, h, edge, bumper = car.width / 2, car.height, car.bonnet_edge, car.bumper
    roof = edge + 0.42 * (h - edge)
    parts = []
    for side in (-1, 1):
        inner, outer = side * 0.70 * w, side * 0.93 * w
        tyre = [(inner, 340.0), (outer, 340.0), (outer, 0.0), (inner, 0.0)]
        parts.append(CarPart("car-wheel", WHEEL, tyre, smooth=False))
        middle = edge + 0.36 * (h - edge)
        turns = [math.pi * k / 6 for k in range(12)]
        mirror = [(side * w + 0.075 * w * math.cos(t), middle + 0.05 * w * math.sin(t)) for t in turns]
        parts.append(CarPart("car-dark", DARK, mirror))
    body = [(0.0, h), (0.34, h - 6), (0.60, h - 45), (0.74, edge + 0.62 * (h - edge)), (0.88, roof - 60)]
    body += [(0.965, edge + 40), (1.0, edge - 110), (1.0, bumper - 20), (0.985, 300), (0.93, 200)]
    parts.append(CarPart("car-body", BODY, _both(w, [*body, (0.7, 168), (0.0, 160)])))
    screen = [(0.0, h - 70), (0.34, h - 76), (0.56, h - 108), (0.68, edge + 0.58 * (h - edge))]
    screen += [(0.79, roof - 75), (0.40, roof - 48), (0.0, roof - 42)]
    parts.append(CarPart("car-glass", GLASS, _both(w, screen)))
    bonnet = [(0.0, edge + 12), (0.45, edge + 4), (0.80, edge - 40), (0.93, edge - 95)]
    line = [*((-a * w, b) for a, b in reversed(bonnet)), *((a * w, b) for a, b in bonnet[1:])]
    parts.append(CarPart("car-line", "", line))
    lamp = [(0.56, edge - 62), (0.74, edge - 70), (0.93, edge - 108), (0.955, edge - 165)]
    lamp += [(0.80, edge - 168), (0.62, edge - 128)]
    parts += [CarPart("car-lamp", LAMP, [(side * a * w, b) for a, b in lamp]) for side in (-1, 1)]
    top, foot = edge - 70, bumper + 75
    if top > foot:
        grille = [(0.0, top), (0.40, top - 4), (0.45, top - 24), (0.40, foot + 4), (0.0, foot)]
        parts.append(CarPart("car-dark", DARK, _both(w, grille)))
    band = [(0.0, bumper + 62), (0.62, bumper + 58), (0.95, bumper + 34), (0.965, bumper - 30)]
    parts.append(CarPart("car-body", BODY, _both(w, [*band, (0.60, bumper - 60), (0.0, bumper - 66)])))
    intake = [(0.0, bumper - 110), (0.56, bumper - 112), (0.64, bumper - 150), (0.56, 215), (0.0, 212)]
    parts.append(CarPart("car-dark", DARK, _both(w, intake)))
    return parts


def car_outline(car: CarFront, x: Scale, z: Scale) -> str:
    """Draw the car; `x` and `z` lead from mm to places in the picture."""
    drawn = ""
    for part in car_parts(car):
        places = [(x(a), z(b)) for a, b in part.points]
        closed = bool(part.fill)
        data = "M" + "L".join(f"{number(a)} {number(b)}" for a, b in places) + "z"
        drawn += tag(
            "path",
            d=smooth(places, closed=closed) if part.smooth else data,
            fill=part.fill or "none",
            stroke=EDGE if part.smooth else None,
            stroke_width=1.5,
            class_=part.css,
        )
    return drawn


def _both(half_width: float, half: Sequence[Place]) -> list[Place]:
    """Return a form of which the right half is given, in half widths and mm, from its top to its bottom."""
    right = [(a * half_width, b) for a, b in half]
    return [*right, *((-a, b) for a, b in reversed(right) if a > 0)]


def smooth(points: Sequence[Place], *, closed: bool = True) -> str:
    """Return path data of a smooth line through points (Catmull and Rom's spline as Bézier curves)."""
    data = [f"M{number(points[0][0])} {number(points[0][1])}"]
    for _, *rest in _arcs(points, closed=closed):
        data.append("C" + " ".join(f"{number(a)} {number(b)}" for a, b in rest))
    return "".join(data) + ("z" if closed else "")


STEPS = 6


def sampled(points: Sequence[Place], *, closed: bool) -> list[Place]:
    """Return the same line as points, `STEPS` to each arc."""
    found = [points[0]]
    for p, q, r, s in _arcs(points, closed=closed):
        for k in range(1, STEPS + 1):
            t = k / STEPS
            parts = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
            corners = (p, q, r, s)
            across = sum(f * c[0] for f, c in zip(parts, corners, strict=True))
            found.append((across, sum(f * c[1] for f, c in zip(parts, corners, strict=True))))
    return found


def _arcs(points: Sequence[Place], *, closed: bool) -> list[tuple[Place, Place, Place, Place]]:
    """Return the Bézier arcs of a spline through points: from, two controls, to."""
    count = len(points)

    def at(index: int) -> Place:
        return points[index % count] if closed else points[min(max(index, 0), count - 1)]

    arcs = []
    for i in range(count if closed else count - 1):
        p0, p1, p2, p3 = at(i - 1), at(i), at(i + 1), at(i + 2)
        first = (p1[0] + (p2[0] - p0[0]) / 9, p1[1] + (p2[1] - p0[1]) / 9)
        second = (p2[0] - (p3[0] - p1[0]) / 9, p2[1] - (p3[1] - p1[1]) / 9)
        arcs.append((p1, first, second, p2))
    return arcs
