"""Finite-element run and lumped model of a front at a few instants, one row each, to scale."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.motion_frames import colour_key
from certkit.reporting.language import Translate, english
from certkit.reporting.number_format import fixed
from certkit.reporting.scales import Scale
from certkit.reporting.svg import Drawing, label, path, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.front_motion import FrontMotion, MovingLine

WIDTH, HEIGHT, LEFT = 740.0, 230.0, 54.0
"""px: of the drawing, of one row, and of the column with the rows' names."""
MOST = 6
"""Instants that are drawn."""
ROOM = 0.02
"""m around what moves."""


def draw(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw the figure of an extraction; None where nothing was recorded in motion."""
    del names
    return run_and_model(result.motion) if result.motion else None


def view_box(motion: FrontMotion) -> tuple[float, float, float, float]:
    """Return x and z ranges (m) of the leg and of what it can reach; a hood is cut off behind."""
    legs = [p for line in motion.lines if line.kind == "leg" for p in _points(line)]
    others = [p for line in motion.lines if line.kind != "leg" for p in _points(line)]
    xs, zs = [p[0] for p in legs or others], [p[1] for p in legs or others]
    nearest = min([p[0] for p in others], default=0.0)
    depth = nearest + 0.3
    right = max(*xs, min(max((p[0] for p in others), default=depth), depth))
    low, high = min([*zs, *(p[1] for p in others)]), max([*zs, *(p[1] for p in others)])
    return min([*xs, nearest]) - ROOM, right + ROOM, low - ROOM, high + ROOM


def moment_peak(motion: FrontMotion) -> float:
    """Return the largest magnitude that colours the leg, at least a hair above zero."""
    rows = [row for line in motion.lines for row in (*line.run_moments, *line.model_moments)]
    return max((abs(v) for row in rows for v in row), default=0.0) or 1.0


def run_and_model(motion: FrontMotion, t: Translate = english) -> Drawing:
    """Draw run and model at the same instants, evenly chosen, the leg coloured by its bending moment."""
    last = len(motion.times) - 1
    frames = sorted({round(last * k / (MOST - 1)) for k in range(MOST)})
    left, right, low, high = view_box(motion)
    cell = (WIDTH - LEFT) / len(frames)
    factor = min((cell - 8) / (right - left), HEIGHT / (high - low))
    height = (high - low) * factor
    peak = moment_peak(motion)
    drawn = ""
    for row, (side, words) in enumerate((("run", t("run")), ("model", t("model")))):
        above = 22 + row * (height + 10)
        drawn += label(4, above + height / 2, words, font_weight="600", class_="title")
        for column, frame in enumerate(frames):
            middle = LEFT + cell * (column + 0.5)
            half = (right - left) / 2 * factor
            x = Scale(left, right, middle - half, middle + half)
            z = Scale(low, high, above + height, above)
            if row == 0:
                time = f"{fixed(motion.times[frame] * 1e3, 0)} ms"
                drawn += label(middle, 13, time, text_anchor="middle", font_weight="600", class_="title")
            drawn += _frame(motion, side, frame, x, z, peak)
    total = 22 + 2 * (height + 10)
    if any(line.run_moments or line.model_moments for line in motion.lines):
        drawn += colour_key(peak, "N·m", LEFT, total + 4, 160, t)
        total += 28
    listed = ", ".join(fixed(motion.times[f] * 1e3, 0) for f in frames)
    words = t("Leg and front in the finite-element run and in the lumped model at {times} ms", times=listed)
    return Drawing(WIDTH, total, drawn, words)


def _points(line: MovingLine) -> list[tuple[float, float]]:
    return [point for frames in (line.run, line.model) for frame in frames for point in frame]


def _frame(motion: FrontMotion, side: str, frame: int, x: Scale, z: Scale, peak: float) -> str:
    inner = ""
    for line in sorted(motion.lines, key=lambda line: ("inside", "face", "leg").index(line.kind)):
        frames = line.run if side == "run" else line.model
        moments = line.run_moments if side == "run" else line.model_moments
        if not frames:
            continue
        points = [(x(a) - x.start, z(b) - z.end) for a, b in frames[frame]]
        data = path(points, closed=line.closed)
        if line.kind != "leg":
            width = 1.1 if line.kind == "face" else 0.7
            inner += tag("path", d=data, fill="none", stroke=palette.INK, stroke_width=width, class_="ink")
            continue
        inner += tag("path", d=data, fill="none", stroke=palette.INK, stroke_width=5, class_="ink")
        for k, piece in enumerate(pairwise(points)):
            colour = palette.diverging(moments[frame][k] / peak) if moments else palette.PAPER
            inner += tag("path", d=path(piece), fill="none", stroke=colour, stroke_width=3.8)
    # A drawing of its own cuts off what reaches beyond the view.
    return tag(
        "svg", inner, x=x.start, y=z.end, width=x.end - x.start, height=z.start - z.end, overflow="hidden"
    )


def leg_colours(motion: FrontMotion, t: Translate) -> Drawing | None:
    """Draw what the leg's colours mean; None where it has none."""
    if not any(line.run_moments or line.model_moments for line in motion.lines):
        return None
    body = colour_key(moment_peak(motion), "N·m", 6, 4, 160, t)
    return Drawing(330, 30, body, t("Colours of the leg: bending moment, N·m"))
