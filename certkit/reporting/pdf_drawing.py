"""Our own drawings on the pages of a PDF, without the typesetter's reader of any SVG.

Charts were a fifth of what a certificate takes: hundreds of short texts and polylines, for each of which a
reader of all SVG looks up dozens of properties, and sets every text twice. Ours know a dozen attributes. A
drawing with anything else in it is left to WeasyPrint.
"""

from __future__ import annotations

import re
from functools import cache
from math import pi, tan
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from certkit.reporting.svg import number

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from xml.etree import ElementTree as ET

    from certkit.reporting.pdf_labels import Labels

SVG = "{http://www.w3.org/2000/svg}"
_BOUNDS = re.compile(r"<svg\b|</svg>")
_STEP = re.compile(r"[A-Za-z]|-?[\d.]+")
_COLOUR = re.compile(r"none|#[0-9a-fA-F]{3}|#[0-9a-fA-F]{6}")
_INHERITED = {
    "fill": "fill",
    "stroke": "stroke",
    "stroke-width": "width",
    "stroke-dasharray": "dashes",
    "stroke-linecap": "cap",
    "stroke-linejoin": "join",
    "fill-opacity": "fill_opacity",
    "stroke-opacity": "stroke_opacity",
    "text-anchor": "anchor",
    "font-size": "size",
    "font-weight": "weight",
}
_OWN = {
    "svg": {"x", "y", "viewBox", "width", "height", "font-family"},
    "g": set[str](),
    "line": {"x1", "y1", "x2", "y2"},
    "rect": {"x", "y", "width", "height"},
    "circle": {"cx", "cy", "r"},
    "path": {"d"},
    "text": {"x", "y"},
    "title": set[str](),
}
_SILENT = re.compile(r"class|role|id|tabindex|aria-.*|data-.*")
"""Attributes that change nothing on paper."""

_CAPS = {"butt": 0, "round": 1, "square": 2}
_JOINS = {"miter": 0, "round": 1, "bevel": 2}
_SHIFT = {"start": 0.0, "middle": 0.5, "end": 1.0}

_QUARTER = 4 / 3 * tan(pi / 8)
"""Length of the handles of a Bézier curve that goes a quarter round a circle of radius 1."""


def split_drawings(html: str) -> Iterator[tuple[str, bool]]:
    """Yield a page in parts: what is between its drawings, and each outermost drawing (then True)."""
    place = depth = 0
    for bound in _BOUNDS.finditer(html):
        opens = bound[0] != "</svg>"
        if opens and depth == 0:
            yield html[place : bound.start()], False
            place = bound.start()
        depth += 1 if opens else -1
        if depth == 0:
            yield html[place : bound.end()], True
            place = bound.end()
    yield html[place:], False


class Inherited(Struct, frozen=True):
    """What an element inherits, beginning with SVG's initial values."""

    fill: str = "#000"
    stroke: str = "none"
    width: str = "1"
    dashes: str = "none"
    cap: str = "butt"
    join: str = "miter"
    fill_opacity: str = "1"
    stroke_opacity: str = "1"
    anchor: str = "start"
    size: str = "16"
    weight: str = "400"


class PdfDrawing:
    """A drawing as an image of WeasyPrint: it says its size and draws itself.

    Parameters
    ----------
    root : Element
        The `svg` element; see `is_known`.
    labels : Labels
        Of the document.
    """

    def __init__(self, root: ET.Element, labels: Labels) -> None:
        self._root = root
        self._labels = labels
        self._size = tuple(float(root.get(name, "0")) for name in ("width", "height"))

    def get_intrinsic_size(self, *_: object) -> tuple[float, float, float]:
        """Return width, height and their ratio."""
        width, height = self._size
        return width, height, width / height

    def draw(self, stream: Any, width: float, height: float, *_: object) -> None:  # noqa: ANN401  # no types
        """Draw it in a width and height, from the upper left corner of the stream's coordinates on."""
        _Ink(stream, self._labels).svg(self._root, Inherited(), width, height)


def is_known(element: ET.Element) -> bool:
    """Tell whether a drawing has nothing in it that is not drawn here."""
    name = element.tag.removeprefix(SVG)
    if name not in _OWN:
        return False
    for key, value in element.attrib.items():
        if key in {"fill", "stroke"} and not _COLOUR.fullmatch(value):
            return False
        if not (key in _INHERITED or key in _OWN[name] or _SILENT.fullmatch(key)):
            return False
    if name == "path" and re.search(r"[^MmLlHhVvZz\d\s,.-]", element.get("d", "")):
        return False
    return all(map(is_known, element))


class _Ink:
    """Writes the operators of a drawing; what was set last is not set again."""

    def __init__(self, stream: Any, labels: Labels) -> None:  # noqa: ANN401  # likewise
        self._stream = stream
        self._labels = labels
        self._last: dict[str, str] = {}

    def svg(self, element: ET.Element, pen: Inherited, width: float, height: float) -> None:
        """Draw a drawing, or one inside another, in a size."""
        _, _, across, down = map(float, element.get("viewBox", f"0 0 {width} {height}").split())
        scale = min(width / across, height / down)
        x, y = (float(element.get(name, "0")) for name in ("x", "y"))
        with self._stream.stacked():
            self._stream.transform(
                scale, 0, 0, scale, x + (width - across * scale) / 2, y + (height - down * scale) / 2
            )
            before, self._last = self._last, {}
            self._children(element, _changed(pen, element))
            self._last = before

    def _children(self, element: ET.Element, pen: Inherited) -> None:
        for child in element:
            name = child.tag.removeprefix(SVG)
            if name == "svg":
                self.svg(child, pen, float(child.get("width", "0")), float(child.get("height", "0")))
            elif name == "g":
                self._children(child, _changed(pen, child))
            elif name == "text":
                self._text(child, _changed(pen, child))
            elif name != "title":
                self._shape(_PATHS[name](child.attrib), _changed(pen, child))

    def _shape(self, path: str, pen: Inherited) -> None:
        filled, stroked = pen.fill != "none", pen.stroke != "none" and float(pen.width) > 0
        if filled:
            self._fill(pen)
        if stroked:
            self._stream.set_alpha(float(pen.stroke_opacity), stroke=True)
            dashes = "" if pen.dashes == "none" else pen.dashes.replace(",", " ")
            self._set("stroke", f"{_channels(pen.stroke)} RG")
            self._set("line", f"{pen.width} w [{dashes}] 0 d {_CAPS[pen.cap]} J {_JOINS[pen.join]} j 4 M")
        paint = "B" if filled and stroked else "f" if filled else "S" if stroked else "n"
        self._stream.stream.append(f"{path} {paint}")

    def _text(self, element: ET.Element, pen: Inherited) -> None:
        words = element.text or ""
        if not words.strip():
            return
        label = self._labels.label(self._stream, words, float(pen.size), _weight(pen.weight))
        x, y = (float(element.get(name, "0")) for name in ("x", "y"))
        self._fill(pen)
        place = f"BT 1 0 0 -1 {number(x - _SHIFT[pen.anchor] * label.width)} {number(y)} Tm"
        self._stream.stream += [place, *label.operators, "ET"]

    def _fill(self, pen: Inherited) -> None:
        self._stream.set_alpha(float(pen.fill_opacity))
        self._set("fill", f"{_channels(pen.fill)} rg")

    def _set(self, what: str, operator: str) -> None:
        if self._last.get(what) != operator:
            self._last[what] = operator
            self._stream.stream.append(operator)


def _changed(pen: Inherited, element: ET.Element) -> Inherited:
    """Return what an element inherits, with what it says itself."""
    own = {_INHERITED[key]: value for key, value in element.attrib.items() if key in _INHERITED}
    return replace(pen, **own) if own else pen


def _weight(word: str) -> int:
    return {"normal": 400, "bold": 700}.get(word) or int(word)


@cache
def _channels(colour: str) -> str:
    """Return red, green and blue from 0 to 1."""
    digits = colour[1:] if len(colour) == 7 else "".join(2 * digit for digit in colour[1:])
    return " ".join(f"{int(digits[i : i + 2], 16) / 255:.4g}" for i in (0, 2, 4))


def _path(attributes: Mapping[str, str]) -> str:
    """Return a polyline; relative steps become places."""
    steps = iter(_STEP.findall(attributes["d"]))
    drawn: list[str] = []
    x = y = start_x = start_y = 0.0
    command = "M"
    for step in steps:
        value = step
        if step.isalpha():
            command = step
            if command in "Zz":
                drawn.append("h")
                x, y = start_x, start_y
                continue
            value = next(steps)
        relative = command.islower()
        if command in "Hh":
            x = float(value) + (x if relative else 0.0)
        elif command in "Vv":
            y = float(value) + (y if relative else 0.0)
        else:
            x = float(value) + (x if relative else 0.0)
            y = float(next(steps)) + (y if relative else 0.0)
        moves = command in "Mm"
        drawn.append(f"{number(x)} {number(y)} {'m' if moves else 'l'}")
        if moves:
            start_x, start_y = x, y
            command = "l" if relative else "L"
    return " ".join(drawn)


def _line(attributes: Mapping[str, str]) -> str:
    x1, y1, x2, y2 = (attributes.get(name, "0") for name in ("x1", "y1", "x2", "y2"))
    return f"{x1} {y1} m {x2} {y2} l"


def _rect(attributes: Mapping[str, str]) -> str:
    return " ".join(attributes.get(name, "0") for name in ("x", "y", "width", "height")) + " re"


def _circle(attributes: Mapping[str, str]) -> str:
    """Return four quarters as Bézier curves."""
    x, y, r = (float(attributes.get(name, "0")) for name in ("cx", "cy", "r"))
    across, down, drawn = r, 0.0, [f"{number(x + r)} {number(y)} m"]
    for _ in range(4):
        next_across, next_down = -down, across
        points = (
            (across - _QUARTER * down, down + _QUARTER * across),
            (next_across + _QUARTER * next_down, next_down - _QUARTER * next_across),
            (next_across, next_down),
        )
        drawn.append(" ".join(f"{x + a:.3f} {y + b:.3f}" for a, b in points) + " c")
        across, down = next_across, next_down
    return " ".join([*drawn, "h"])


_PATHS = {"path": _path, "line": _line, "rect": _rect, "circle": _circle}
