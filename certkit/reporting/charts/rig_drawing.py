"""The rig as it stands in the laboratory, to scale: legform, fixtures, ground, gravity, and what each is."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.channel_names import is_channel
from certkit.reporting.charts.motion_frames import FILL, placed
from certkit.reporting.language import english
from certkit.reporting.scales import Scale
from certkit.reporting.svg import Drawing, label, path, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result
    from certkit.documents.rig_motion import Motion, Shape
    from certkit.reporting.language import Translate

_ORDER = ("ground", "ghost", "rig", "flesh", "mass", "knee", "bone", "honeycomb", "ram", "vehicle")
_WIDTH, _HEIGHT = 740.0, 430.0
_BESIDE, _BELOW, _LINE = 170.0, 40.0, 15.0
"""px: column of names on the right, strip of scale and gravity below, and the height of a name."""
_LETTER, _NARROWEST = 6.6, 380.0
"""px: width of a letter, and of the narrowest drawing: scale and gravity have room."""
_BARS = (1.0, 0.5, 0.2, 0.1, 0.05)
"""m: lengths of the scale bar, the longest that fits is taken."""
Outline = list[tuple[float, float]]


def draw(result: Result, names: Sequence[str]) -> Drawing | None:
    """Draw the figure of a result; None where no motion was recorded."""
    del names
    motion = result.motion
    return rig_drawing(motion) if motion and motion.poses else None


def rig_drawing(motion: Motion, *, t: Translate = english) -> Drawing:
    """Draw the rig at the first instant of the run, with a line to each part's name."""
    pieces = [(shape, list(shape.outline)) for shape in (*motion.before, *motion.scene)]
    pieces += [(s, placed(s, pose)) for s, pose in zip(motion.shapes, motion.poses[0], strict=True)]
    pieces.sort(key=lambda piece: _ORDER.index(piece[0].kind))
    points = [point for _, outline in pieces for point in outline]
    left, right = min(p[0] for p in points), max(p[0] for p in points)
    low, high = min(p[1] for p in points), max(p[1] for p in points)
    factor = min((_WIDTH - _BESIDE - 20) / (right - left), _HEIGHT / (high - low))
    height = (high - low) * factor
    x = Scale(left, right, 10.0, 10.0 + (right - left) * factor)
    z = Scale(low, high, 10.0 + height, 10.0)
    drawn = "".join(_piece(shape, [(x(a), z(b)) for a, b in outline]) for shape, outline in pieces)
    named = _named([(_of_front(shape, t), outline) for shape, outline in pieces])
    total = max(height, len(named) * _LINE) + 20 + _BELOW
    drawn += _names([(words, x(a), z(b)) for words, (a, b) in named], x.end + 24, height + 10)
    drawn += _below(motion, factor, total - _BELOW + 8, t)
    width = min(_WIDTH, max(x.end + 34 + _LETTER * max(len(words) for words, _ in named), _NARROWEST))
    said = ", ".join(words for words, _ in named)
    return Drawing(width, total, drawn, t("The rig in the laboratory, to scale: {parts}", parts=said))


def _piece(shape: Shape, outline: Outline) -> str:
    closed = path(outline, closed=True)
    css = f"k-{shape.kind}"
    if shape.kind == "ghost":
        dash = {"stroke": palette.MUTED, "stroke_dasharray": "3 2"}
        return tag("path", d=closed, fill="none", class_=css, stroke_width=0.5, **dash)
    line = tag("path", d=closed, fill=FILL[shape.kind], stroke=palette.INK, stroke_width=0.7, class_=css)
    return line + (_hatching(outline) if shape.kind == "ground" else "")


def _hatching(outline: Outline) -> str:
    """Draw the oblique lines by which something is known to be fixed, inside an upright box."""
    left, right = min(p[0] for p in outline), max(p[0] for p in outline)
    top, bottom = min(p[1] for p in outline), max(p[1] for p in outline)
    size = min(right - left, bottom - top)
    flat = right - left > bottom - top
    lines, place = "", 0.0
    while place + size <= (right - left if flat else bottom - top) + 1e-6:
        start, end = (
            ((left + place, bottom), (left + place + size, top))
            if flat
            else ((left, top + place + size), (right, top + place))
        )
        lines += path([start, end])
        place += max(size, 3.0)
    return tag("path", d=lines, stroke=palette.INK, stroke_width=0.6, fill="none", class_="k-ground")


def _of_front(shape: Shape, t: Translate) -> Shape:
    """Return a shape whose name says that it is a face, where a gauge of the leg is called so too."""
    called = shape.kind == "vehicle" and is_channel(shape.name)
    return shape.model_copy(update={"name": t("face {name}", name=shape.name)}) if called else shape


def _named(pieces: Sequence[tuple[Shape, Outline]]) -> list[tuple[str, tuple[float, float]]]:
    """Return each name once, with its note, and the middle of the piece that it stands for.

    Pieces that are numbered (`tibia 3`) are one part; its middle piece stands for it.
    """
    found: dict[str, list[tuple[Shape, Outline]]] = {}
    for shape, outline in pieces:
        word, _, number = shape.name.rpartition(" ")
        numbered = number.isdigit() and shape.kind in {"bone", "knee", "flesh"}
        found.setdefault(word if numbered else shape.name, []).append((shape, outline))
    named = []
    for name, each in found.items():
        outline = each[len(each) // 2][1] if each[0][0].kind != "ghost" else each[0][1]
        note = next((shape.note for shape, _ in each if shape.note), "")
        middle = (
            (min(p[0] for p in outline) + max(p[0] for p in outline)) / 2,
            (min(p[1] for p in outline) + max(p[1] for p in outline)) / 2,
        )
        named.append((f"{name}, {note}" if note else name, middle))
    return sorted(named, key=lambda item: -item[1][1])


def _names(named: Sequence[tuple[str, float, float]], at: float, height: float) -> str:
    """Draw names in a column, from the top in the order of their heights, each with a line to its piece."""
    drawn, last = "", 0.0
    for number, (words, x, y) in enumerate(named):
        left = len(named) - number - 1
        place = max(last + _LINE, min(y, max(height, len(named) * _LINE) - left * _LINE))
        last = place
        line = path([(x, y), (at - 10, place), (at - 3, place)])
        drawn += tag("path", d=line, stroke=palette.MUTED, stroke_width=0.6, fill="none", class_="leader")
        drawn += tag("circle", cx=x, cy=y, r=1.6, fill=palette.INK, class_="ink")
        drawn += label(at, place + 3.8, words, class_="tick")
    return drawn


def _below(motion: Motion, factor: float, y: float, t: Translate) -> str:
    """Draw the scale bar, and gravity where the run has it."""
    bar = next((length for length in _BARS if length * factor <= 160), _BARS[-1])
    end = 10 + bar * factor
    ruler = path([(10, y), (10, y + 8)]) + path([(10, y + 4), (end, y + 4)]) + path([(end, y), (end, y + 8)])
    drawn = tag("path", d=ruler, stroke=palette.INK, stroke_width=1, fill="none", class_="ink")
    drawn += label(end + 8, y + 8, f"{bar * 1000:g} mm", class_="tick")
    if motion.gravity is None:
        return drawn
    at = end + 90
    if not motion.gravity:
        return drawn + label(at, y + 8, t("gravity left out"), class_="tick")
    arrow = path([(at, y - 6), (at, y + 16)]) + path([(at - 4, y + 9), (at, y + 16), (at + 4, y + 9)])
    drawn += tag("path", d=arrow, stroke=palette.INK, stroke_width=1.4, fill="none", class_="ink")
    return drawn + label(
        at + 10, y + 8, t("gravity, {value} m/s²", value=f"{motion.gravity:g}"), class_="tick"
    )
