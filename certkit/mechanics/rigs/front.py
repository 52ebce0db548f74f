"""The vehicle test: the leg in free flight against a front of lumped groups.

The leg starts where it just touches the front. Heights are the vehicle document's, above the ground, less
the height of the knee centre; the ground is as far below the leg's lower end as the flight says.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

from certkit.errors import RunError
from certkit.mechanics.laws import FRONT, POINTS, SPRINGS
from certkit.mechanics.rigs.site import GRAVITY, Site
from certkit.mechanics.rigs.stopper import BARE
from certkit.mechanics.world import GROUND

if TYPE_CHECKING:
    from certkit.definitions.rig import FreeFlight
    from certkit.definitions.vehicle import Connection, Group, Vehicle

STRIP = 0.008
"""m: faces are cut into strips of at most this height. Halving it changes no peak by more than 0.5 %."""

JOINED = 0.01
"""m: faces of one kind whose ends are nearer than this are one line."""

STIFF_UNLOADING = 4.0
"""Unloading stiffness over the secant of the loading curve, where the vehicle document gives none."""


@dataclass(frozen=True)
class Strip:
    """A strip of a face: the groups it moves with, in what shares; its place from the knee centre, m."""

    lower: str
    upper: str
    share: float
    x: float
    z: float
    height: float


def fit_front(site: Site, vehicle: Vehicle, flight: FreeFlight) -> None:
    """Throw the leg at the front.

    Raises
    ------
    RunError
        When the leg would miss every face.
    """
    ground = site.leg.bottom - float(flight.end_above_ground)
    strips = face_strips(vehicle, ground)
    angle = float(flight.angle)
    start = _touching(site, strips, angle)
    if angle != 0.0:
        site.assembly.turn(angle, 0.0, 0.0)
    site.assembly.throw(float(flight.speed), 0.0)
    bodies = {name: _add_group(site, name, group, ground) for name, group in vehicle.groups.items()}
    rest = {name: site.assembly.centre(body)[0] for name, body in bodies.items()}
    compression = float(site.legform.flesh.compression) if site.cover > 0 else BARE
    for strip in strips:
        moved = (1 - strip.share) * rest[strip.lower] + strip.share * rest[strip.upper]
        site.assembly.add_row(
            FRONT,
            (bodies[strip.lower], bodies[strip.upper]),
            {
                "face x": strip.x + start - moved,
                "face z": strip.z,
                "share": strip.share,
                "height": strip.height,
                "compression": compression,
                "stiffening depth": float(site.legform.flesh.thickness),
                "thickness": site.cover,
                "friction": float(vehicle.friction or 0.0),
            },
        )
    for connection in vehicle.connections:
        _add_spring(site, connection, bodies, rest)
    site.assembly.gravity = (0.0, -GRAVITY)
    site.trigger = FRONT
    site.longest = 0.01
    site.front = bodies
    site.strips = tuple(strips)
    for name, group in vehicle.groups.items():
        _draw(site, bodies[name], name, group, ground, start)


def face_strips(vehicle: Vehicle, ground: float) -> list[Strip]:
    """Cut all faces into strips, from the top; neighbours share the height between their middles."""
    faced = [(name, group) for name, group in vehicle.groups.items() if group.position is not None]
    faced.sort(key=lambda item: (item[1].kind, float(item[1].low or 0.0)))
    above: dict[str, str] = {}
    below: dict[str, str] = {}
    for (first_name, lower), (second_name, upper) in pairwise(faced):
        if lower.kind == upper.kind and abs(float(upper.low or 0.0) - float(lower.high or 0.0)) <= JOINED:
            above[first_name], below[second_name] = second_name, first_name
    middles = {name: 0.5 * (float(g.low or 0.0) + float(g.high or 0.0)) for name, g in faced}
    strips = []
    for name, group in faced:
        low, high = float(group.low or 0.0), float(group.high or 0.0)
        count = max(1, math.ceil((high - low) / STRIP - 1e-9))
        for k in range(count):
            z = low + (k + 0.5) * (high - low) / count
            x = float(group.position or 0.0) + float(group.slope or 0.0) * (z - middles[name])
            first, second = (name, above.get(name)) if z >= middles[name] else (below.get(name), name)
            if first is None or second is None:
                strips.append(Strip(name, name, 0.0, x, z + ground, (high - low) / count))
                continue
            share = (z - middles[first]) / (middles[second] - middles[first])
            strips.append(Strip(first, second, share, x, z + ground, (high - low) / count))
    return sorted(strips, key=lambda s: -s.z)


def _touching(site: Site, strips: list[Strip], angle: float) -> float:
    """Return by how much the front has to be moved along x so that it just touches the leg."""
    gaps = []
    tangent, cosine = math.tan(angle), math.cos(angle)
    for strip in strips:
        height = strip.z / cosine
        for segment in site.leg.segments:
            if segment.bottom <= height <= segment.top:
                face = -strip.z * tangent + (segment.depth / 2 + site.cover) / cosine
                gaps.append(strip.x - face)
                break
    if not gaps:
        raise RunError(
            "the leg flies past the front without touching it; check the faces' heights and the flight's"
        )
    return -min(gaps)


def _add_group(site: Site, name: str, group: Group, ground: float) -> int:
    middle = 0.5 * (float(group.low) + float(group.high)) if group.low and group.high else -ground
    return site.assembly.add_body(name, float(group.mass), 0.0, (0.0, middle + ground, 0.0), guided=True)


def loading_curve(connection: Connection) -> tuple[list[tuple[float, float]], list[tuple[float, float]]]:
    """Return the points (x, F) of the pushing and of the pulling side, both from zero and both positive.

    A gap is put in front, and the last slope, with bottoming, behind; a one-sided spring has no pulling
    points.
    """
    gap = float(connection.gap or 0.0)
    points = sorted((float(x), float(f)) for x, f in connection.loading)
    push = [(x + gap, f) for x, f in points if x > 0]
    pull = [(-x, -f) for x, f in reversed(points) if x < 0]
    origin = next((f for x, f in points if x == 0), 0.0)
    push = [(0.0, 0.0), *([(gap, max(origin, 0.0))] if gap > 0 else []), *push]
    if len(push) == 1:
        push.append((1e-3 + gap, 0.0))
    if connection.bottoming is not None:
        push = _bottomed(push, float(connection.bottoming.at) + gap, float(connection.bottoming.stiffness))
    if not connection.tension:
        return push, []
    if not pull:  # nothing else is said: it pulls as it pushes
        pull = [(x, f) for x, f in push if x > 0]
    return push, [(0.0, 0.0), *pull]


def _bottomed(points: list[tuple[float, float]], at: float, stiffness: float) -> list[tuple[float, float]]:
    """Add a stiffness beyond `at` to a curve that goes on with its last slope."""
    (x0, f0), (x1, f1) = points[-2:]
    slope = max((f1 - f0) / (x1 - x0), 0.0)

    def plain(x: float) -> float:
        if x >= x1:
            return f1 + slope * (x - x1)
        left, right = next((a, b) for a, b in pairwise(points) if a[0] <= x <= b[0])
        return left[1] + (right[1] - left[1]) * (x - left[0]) / (right[0] - left[0])

    places = sorted({x for x, _ in points} | {at, max(x1, at) + 0.01})
    return [(x, plain(x) + stiffness * max(x - at, 0.0)) for x in places]


def _add_spring(site: Site, connection: Connection, bodies: dict[str, int], rest: dict[str, float]) -> None:
    push, pull = loading_curve(connection)
    first, second = connection.between
    table = {}
    for side, points in (("push", push), ("pull", pull)):
        table[f"{side} from"] = float(site.assembly.rows(POINTS))
        table[f"{side} points"] = float(len(points))
        for x, force in points:
            site.assembly.add_row(POINTS, (), {"shortening": x, "force": force})
    steepest = max((f / x for x, f in (*push, *pull) if x > 0), default=0.0)
    unloading = STIFF_UNLOADING * steepest if connection.unloading is None else float(connection.unloading)
    site.assembly.add_row(
        SPRINGS,
        (bodies.get(first, GROUND), bodies.get(second, GROUND)),
        {
            "rest": rest.get(first, 0.0) - rest.get(second, 0.0),
            **table,
            "unloading": max(unloading, 1.0),
            "residual": float(connection.residual or 0.0),
            "permanent set": float(connection.permanent_set or 0.0),
            "damping": float(connection.damping or 0.0),
        },
    )
    site.springs = (*site.springs, f"{first} – {second}")


def _draw(site: Site, body: int, name: str, group: Group, ground: float, start: float) -> None:
    """Draw a group's face as a thin slab, in the body's frame."""
    if group.low is None or group.high is None:
        return
    low, high = float(group.low), float(group.high)
    middle, x = 0.5 * (low + high), float(group.position or 0.0) + start
    slope = float(group.slope or 0.0)
    centre = site.assembly.centre(body)
    ends = [(x + slope * (z - middle) - centre[0], z + ground - centre[1]) for z in (low, high)]
    site.figures[body] = (name, (*ends, *((px + 0.012, pz) for px, pz in reversed(ends))))
