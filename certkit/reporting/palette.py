"""Colours that survive colour-blind eyes and a grey printer.

Curves take Okabe and Ito's colours, darkened where they were too light for lines on white, and each comes
with a dash pattern of its own, so that colour never carries a meaning alone. Every text colour has a
contrast of at least 4.5 on white. SVG carries these colours as attributes (WeasyPrint reads no page style
inside SVG); the HTML page overrides them by class in its dark theme.
"""

from __future__ import annotations

from typing import NamedTuple

INK = "#16202c"
MUTED = "#536070"
LINE = "#cfd6dd"
GRID = "#e3e8ed"
PAPER = "#ffffff"
CORRIDOR = "#d5e8de"
CORRIDOR_EDGE = "#2e7d5b"
GUARD = "#f3dfb3"
ACCENT = "#0b5cad"

VERDICT = {
    "pass": "#0a6847",
    "fail": "#b3261e",
    "conditional": "#855300",
    "not evaluated": "#536070",
    "error": "#7b2d8b",
}


class Pen(NamedTuple):
    """A line colour with the dash pattern that tells it apart without colour."""

    colour: str
    dash: str | None


PENS = (
    Pen("#0072b2", None),
    Pen("#c04e00", "7 3"),
    Pen("#00795a", "2 2.5"),
    Pen("#9a3d7f", "9 3 2 3"),
    Pen("#3a3f45", "4 2"),
    Pen("#946200", "1 3"),
    Pen("#2f7fb5", "12 4"),
)

_DASHES = (
    *(pen.dash for pen in PENS),
    *("12 3 2 3 2 3", "5 5", "14 3 4 3", "3 1.2", "8 2 1 2 1 2", "1 1.5", "16 5", "6 2 6 6"),
)

GROUP_PENS = tuple(
    Pen(PENS[k % len(PENS)].colour, _DASHES[k % len(_DASHES)]) for k in range(len(PENS) * len(_DASHES))
)
"""Pens for many lines of one report: the first 15 differ in their dashes, the first 105 in colour or dash."""

# Anchors of the diverging colour scale of bending moments: −1, −½, 0, +½, +1. Lightness falls evenly to both
# sides, so a grey print still shows the magnitude.
_ANCHORS = ((8, 69, 148), (107, 163, 209), (232, 230, 224), (240, 155, 84), (166, 47, 14))


def diverging(fraction: float) -> str:
    """Return the colour of a value between −1 and 1 as `#rrggbb`; values beyond are clipped."""
    place = (min(1.0, max(-1.0, fraction)) + 1) * 2
    index = min(int(place), 3)
    part = place - index
    low, high = _ANCHORS[index], _ANCHORS[index + 1]
    return "#" + "".join(f"{round(a + (b - a) * part):02x}" for a, b in zip(low, high, strict=True))
