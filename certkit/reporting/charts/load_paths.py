"""The load paths of a front to scale in height: groups, and between them what each path passed on.

The breadth of a path is its impulse, which adds up: what enters a group and does not leave it has moved it.
"""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.grid import together
from certkit.reporting.charts.group_places import FACE, GROUND, TALL, GroupPlace, group_places, short
from certkit.reporting.coupled_check import check_of, worst_group
from certkit.reporting.language import Translate, english
from certkit.reporting.number_format import plain
from certkit.reporting.scales import Scale, ticks
from certkit.reporting.svg import Drawing, label, number, tag

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.documents.extraction import ExtractionResult, GroupResult

WIDTH, HEIGHT, TOP, BOTTOM = 400.0, 520.0, 40.0, 26.0
LEG = 52.0
"""px: where the leg stands."""
BESIDE, NARROW = 4, 32.0
"""Letters of a face's name beside the number of what presses on it; px of a gap too narrow for a number."""
BROADEST, LEAST = 26.0, 0.004
"""px of the broadest path; share of it below which a path is left out."""
BULGE = 30.0
"""px: how far the arc between neighbours stands out."""
TOLD = 0.02
"""Share of the largest from which a path's number stands on it."""
GROUND_NAME = "ground"


def draw(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw run and model side by side; None where no group has a face."""
    del names
    return together(sketches(result), f"Load paths of the front in run and model, {result.title}")


def sketches(result: ExtractionResult, t: Translate = english) -> list[Drawing]:
    """Return the sketch of the run and, where there is a coupled run, that of the model, at one scale."""
    if not result.times or not any(group.position is not None for group in result.groups):
        return []
    check = check_of(result, "coupled")
    until = check.until if check else result.times[-1]
    last = sum(t <= until + 1e-9 for t in result.times) - 1
    run = {path.name: path.impulse[last] for path in result.paths}
    if check is None:
        return [_sketch(result, run, t("Finite-element run"), _largest(run), t)]
    model = {path.name: path.impulse for path in check.paths}
    impactors = {group.name for group in result.groups if group.kind == "impactor"}
    for path in result.paths:
        pressed = next((g.impulse for g in check.groups if g.name == path.target), None)
        if path.source in impactors and pressed is not None:
            model[path.name] = pressed
    largest = max(_largest(run), _largest(model))
    return [
        _sketch(result, run, t("Finite-element run"), largest, t),
        _sketch(result, model, t("Lumped model"), largest, t),
    ]


def _largest(impulses: Mapping[str, float]) -> float:
    return max((abs(v) for v in impulses.values()), default=0.0) or 1.0


def _sketch(
    result: ExtractionResult, impulses: Mapping[str, float], title: str, largest: float, t: Translate
) -> Drawing:
    groups = {group.name: group for group in result.groups}
    faces = [g for g in result.groups if g.position is not None and g.low is not None and g.high is not None]
    low, high = min(g.low or 0.0 for g in faces) - 0.06, max(g.high or 0.0 for g in faces) + 0.06
    z = Scale(low, high, HEIGHT - BOTTOM, TOP)
    places = group_places(result, z)
    drawn = _axis(z, t) + label(6, 14, title, font_weight="600", class_="title")
    drawn += label(
        WIDTH - 6, 14, t("impulse, N·s"), text_anchor="end", fill=palette.MUTED, class_="tick unit"
    )
    bands, words, said = "", "", []
    shown = sorted(
        (p for p in result.paths if abs(impulses.get(p.name, 0.0)) > LEAST * largest),
        key=lambda p: -abs(impulses[p.name]),
    )
    taken = [(place.x, place.z) for place in places.values() if place.x > FACE]
    for path in shown:
        value = impulses[path.name]
        source, target = places.get(path.source), places.get(path.target)
        if target is None and path.target == GROUND_NAME and source is not None:
            target = GroupPlace(GROUND, source.z, GROUND, GROUND)
        if groups.get(path.source) and groups[path.source].kind == "impactor" and target is not None:
            source = GroupPlace(LEG, target.z, LEG, LEG + 6)
        if source is None or target is None:
            continue
        breadth = max(BROADEST * abs(value) / largest, 0.8)
        band, at = _band(source, target, breadth, pulls=value < 0, name=path.name, value=value)
        bands += band
        if abs(value) > TOLD * largest:
            beside = (source.x == LEG and len(short(path.target)) > BESIDE) or (
                0 < target.left - source.right < NARROW
            )
            words += _number((at[0], at[1] + 13) if beside else at, value, taken)
            said.append(f"{path.name} {plain(value, 3)}")
    leg = tag(
        "rect",
        fill=palette.LINE,
        x=LEG - 6,
        y=TOP - 8,
        width=12,
        height=HEIGHT - BOTTOM - TOP + 8,
        rx=5,
        class_="leg-bar",
    )
    wall = f"M{number(GROUND)} {number(TOP)}V{number(HEIGHT - BOTTOM)}"
    drawn += bands + leg + tag("path", d=wall, stroke=palette.MUTED, stroke_width=3, class_="zero")
    hit = next((group.name for group in result.groups if group.kind == "impactor"), "leg")
    drawn += label(LEG, TOP - 13, hit, text_anchor="middle", class_="key")
    drawn += label(GROUND + 6, TOP - 6, t("ground"), text_anchor="end", class_="key")
    worst = worst_group(result)
    boxes = (_box(g, places[g.name], z, worst=g.name == worst) for g in result.groups if g.name in places)
    drawn += "".join(boxes) + words
    listed = "; ".join(said)
    return Drawing(WIDTH, HEIGHT, drawn, f"{title}, {t('load paths with their impulses, N·s')}: {listed}")


def _axis(z: Scale, t: Translate) -> str:
    drawn = ""
    for value in ticks(z.low * 1e3, z.high * 1e3, 8):
        y = z(value / 1e3)
        drawn += label(30, y + 3.6, plain(value), text_anchor="end", fill=palette.MUTED, class_="tick")
        drawn += tag("path", d=f"M34 {number(y)}h5", stroke=palette.MUTED, class_="zero")
    words = t("height above ground, mm")
    return drawn + label(6, HEIGHT - 8, words, fill=palette.MUTED, class_="tick")


def _band(
    source: GroupPlace, target: GroupPlace, breadth: float, *, pulls: bool, name: str, value: float
) -> tuple[str, tuple[float, float]]:
    """Draw a path as a curve of its breadth, and return where its number stands; one that pulls is dashed."""
    if abs(source.x - target.x) < 1:  # neighbours: an arc in front of both
        left = source.left - BULGE
        data = (
            f"M{number(source.left)} {number(source.z)}C{number(left)} {number(source.z)} "
            f"{number(left)} {number(target.z)} {number(target.left)} {number(target.z)}"
        )
        at = (source.left - 0.75 * BULGE, 0.5 * (source.z + target.z))
    else:
        middle = 0.5 * (source.right + target.left)
        data = (
            f"M{number(source.right)} {number(source.z)}C{number(middle)} {number(source.z)} "
            f"{number(middle)} {number(target.z)} {number(target.left)} {number(target.z)}"
        )
        # Near its beginning, where paths to one group lie apart; to the ground behind all groups.
        t = 0.72 if target.x >= GROUND else 0.35
        rise = t * t * (3 - 2 * t)
        along = 1.5 * t * (1 - t) ** 2 + 1.5 * t * t * (1 - t) + t**3
        at = (
            source.right + along * (target.left - source.right),
            source.z + rise * (target.z - source.z),
        )
    pen = palette.PENS[1 if pulls else 0]
    told = tag("title", escape(f"{name}: {plain(value, 3)} N·s{', pulls' if pulls else ''}"))
    drawn = tag(
        "path",
        told,
        d=data,
        fill="none",
        stroke=pen.colour,
        stroke_opacity=0.5,
        stroke_width=breadth,
        stroke_dasharray="5 3" if pulls else None,
        class_=f"p{1 if pulls else 0}",
    )
    return drawn, at


def _number(at: tuple[float, float], value: float, taken: list[tuple[float, float]]) -> str:
    """Write a path's number on it, a line lower where another one stands already."""
    x, y = at[0], at[1] + 3.6
    while any(abs(x - a) < 30 and abs(y - b) < 11 for a, b in taken):
        y += 11
    taken.append((x, y))
    words = plain(value, 3)
    return _ground(x, y, words) + label(x, y, words, text_anchor="middle", class_="key", font_size=10.5)


def _ground(x: float, y: float, words: str) -> str:
    """Draw a patch of paper on which words centred at x can be read."""
    width = 5.9 * len(words) + 6
    return tag(
        "rect",
        x=x - width / 2,
        y=y - 9.5,
        width=width,
        height=12.5,
        rx=3,
        fill=palette.PAPER,
        fill_opacity=0.85,
        class_="patch",
    )


def _box(group: GroupResult, place: GroupPlace, z: Scale, *, worst: bool) -> str:
    colour = palette.VERDICT["fail"] if worst else palette.INK
    if group.position is not None:
        top, bottom = z(group.high or 0.0), z(group.low or 0.0)
        bar = tag(
            "rect",
            x=place.left,
            y=top + 1.5,
            width=10,
            height=max(bottom - top - 3, 4),
            rx=2,
            fill=colour,
            class_="worst-group" if worst else "face-bar",
        )
        name = label(
            place.left - 5,
            place.z + 4,
            short(group.name),
            text_anchor="end",
            class_="worst-group" if worst else "key",
            font_weight="600",
            fill=colour,
        )
        return (
            bar + _ground(place.left - 5 - 3 * len(short(group.name)), place.z + 4, short(group.name)) + name
        )
    frame = tag(
        "rect",
        x=place.left,
        y=place.z - TALL / 2,
        width=place.right - place.left,
        height=TALL,
        rx=4,
        fill=palette.PAPER,
        stroke=colour,
        stroke_width=2 if worst else 1.2,
        class_="group-box worst-box" if worst else "group-box",
    )
    return frame + label(place.x, place.z + 4, short(group.name), text_anchor="middle", class_="key")
