"""Still pictures of the moving legform and rig at a few instants, coloured by bending moment."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.grid import side_by_side
from certkit.reporting.language import english
from certkit.reporting.number_format import fixed, plain
from certkit.reporting.scales import Scale
from certkit.reporting.svg import Drawing, label, path, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result
    from certkit.documents.rig_motion import Motion, Shape
    from certkit.reporting.language import Translate

WIDTH = 740.0

MOST = 6
"""Instants that are drawn."""

FILL = {
    "bone": "#e8e6e0",
    "knee": "#c5ccd4",
    "flesh": "#f6ede3",
    "rig": "#8b949e",
    "ram": "#aab4be",
    "vehicle": "#dfe5ea",
    "mass": "#6b7580",
    "honeycomb": "#d9c58f",
    "ground": "#d0d4d9",
    "ghost": "none",
}
_ORDER = ("rig", "flesh", "mass", "knee", "bone", "honeycomb", "ram", "vehicle")
"""From back to front. What the leg crushes is drawn in front of it and half seen through."""
_SEEN_THROUGH = {"honeycomb": 0.6, "ram": 0.7, "vehicle": 0.7}


def draw(result: Result, names: Sequence[str]) -> Drawing | None:
    """Draw the figure of a result; None where no motion was recorded."""
    del names
    motion = result.motion
    return frames_chart(motion) if motion and motion.poses else None


def draw_beside(result: Result, beside: Result, names: Sequence[str]) -> Drawing | None:
    """Draw the key frames of two results, one row each, at the same instants."""
    del names
    first, second = result.motion, beside.motion
    if not (first and first.poses and second and second.poses):
        return None
    shared = sum(t <= second.times[-1] + 1e-9 for t in first.times)
    frames = key_frames(
        first.model_copy(update={"poses": first.poses[:shared], "moments": first.moments[:shared]})
    )
    instants = [first.times[frame] for frame in frames]
    nearest = [min(range(len(second.times)), key=lambda i: abs(second.times[i] - t)) for t in instants]
    rows = [frames_chart(first, frames), frames_chart(second, nearest)]
    return side_by_side(rows, f"{result.title} and {beside.title} at the same instants", columns=1)


def placed(shape: Shape, pose: tuple[float, float, float]) -> list[tuple[float, float]]:
    """Return a shape's outline in world axes."""
    x, z, angle = pose
    c, s = math.cos(angle), math.sin(angle)
    return [(x + c * a - s * b, z + s * a + c * b) for a, b in shape.outline]


def bounds(motion: Motion, frames: Sequence[int] | None = None) -> tuple[float, float, float, float]:
    """Return x and z ranges (m) that all shapes stay in over the given frames, with some room."""
    frames = range(len(motion.poses)) if frames is None else frames
    points = [
        p
        for f in frames
        for shape, pose in zip(motion.shapes, motion.poses[f], strict=True)
        for p in placed(shape, pose)
    ]
    points += [p for shape in motion.scene for p in shape.outline]
    xs, zs = [p[0] for p in points] or [0.0, 1.0], [p[1] for p in points] or [0.0, 1.0]
    room = 0.03 * max(max(xs) - min(xs), max(zs) - min(zs), 1e-3)
    return min(xs) - room, max(xs) + room, min(zs) - room, max(zs) + room


def largest_moment(motion: Motion) -> float:
    """Return the largest magnitude that colours a joint, at least a hair above zero."""
    return max((abs(v) for row in motion.moments for v in row), default=0.0) or 1.0


def key_frames(motion: Motion) -> list[int]:
    """Choose instants: the first, the one of the largest moment, and others evenly around it."""
    count = len(motion.poses)
    if count <= MOST:
        return list(range(count))
    sizes = [max((abs(v) for v in row), default=0.0) for row in motion.moments] or [0.0] * count
    top = max(range(len(sizes)), key=lambda i: sizes[i])
    end = min(count - 1, max(2 * top, MOST - 1)) if top else count - 1
    evenly = [round(end * i / (MOST - 1)) for i in range(MOST)]
    if top:
        nearest = min(range(1, MOST), key=lambda i: abs(evenly[i] - top))
        evenly[nearest] = top
    return sorted(set(evenly))


def _shape(points: list[tuple[float, float]], shape: Shape, fill: str, css: str) -> str:
    if shape.closed:
        seen = _SEEN_THROUGH.get(shape.kind)
        return tag("path", d=path(points, closed=True), fill=fill, fill_opacity=seen, class_=css)
    return tag("path", d=path(points), fill="none", stroke_width=1.2, class_=css)


def draw_frame(motion: Motion, frame: int, x: Scale, y: Scale) -> str:
    """Draw one instant: what stands still first, then vehicle, ram, flesh and last the bones."""
    peak = largest_moment(motion)
    colour = {name: index for index, name in enumerate(motion.joints)}
    drawn = [
        _shape([(x(a), y(b)) for a, b in shape.outline], shape, FILL[shape.kind], f"k-{shape.kind}")
        for shape in motion.scene
    ]
    pairs = list(zip(motion.shapes, motion.poses[frame], strict=True))
    for kind in _ORDER:
        for shape, pose in pairs:
            if shape.kind != kind:
                continue
            fill, css = FILL[kind], f"k-{kind}"
            if shape.name in colour and motion.moments:
                fill, css = palette.diverging(motion.moments[frame][colour[shape.name]] / peak), "k-coloured"
            drawn.append(_shape([(x(a), y(b)) for a, b in placed(shape, pose)], shape, fill, css))
    return tag("g", "".join(drawn), stroke=palette.INK, stroke_width=0.6, stroke_opacity=0.75)


def frames_chart(
    motion: Motion,
    frames: Sequence[int] | None = None,
    *,
    t: Translate = english,
) -> Drawing:
    """Draw the key frames at one scale, with their times and a colour key.

    They stand side by side; those that are wide, as of a bone on its rollers, in three columns.
    """
    frames = key_frames(motion) if frames is None else frames
    left, right, low, high = bounds(motion, frames)
    columns = max(len(frames), 1) if high - low > 1.2 * (right - left) else 3
    cell = WIDTH / columns
    factor = min((cell - 8) / (right - left), 300 / (high - low))
    height = (high - low) * factor
    drawn = ""
    for place, frame in enumerate(frames):
        row, column = divmod(place, columns)
        above = row * (height + 24)
        middle = cell * (column + 0.5)
        half = (right - left) / 2 * factor
        x = Scale(left, right, middle - half, middle + half)
        y = Scale(low, high, above + 20 + height, above + 20)
        words = f"{fixed(motion.times[frame] * 1e3, 1)} ms"
        drawn += label(middle, above + 13, words, text_anchor="middle", font_weight="600", class_="title")
        drawn += draw_frame(motion, frame, x, y)
    total = -(-len(frames) // columns) * (height + 24)
    if motion.moments:
        drawn += colour_key(largest_moment(motion), motion.unit, 6, total + 6, 180, t)
        total += 32
    listed = ", ".join(fixed(motion.times[f] * 1e3, 1) for f in frames)
    said = t("Legform and rig at {times} ms, coloured by bending moment", times=listed)
    return Drawing(WIDTH, total, drawn, said)


def colour_key(peak: float, unit: str, x: float, y: float, width: float, t: Translate) -> str:
    """Draw the colour scale of bending moments with its ends, ±`peak`, and its unit."""
    cells = 24
    drawn = "".join(
        tag(
            "rect",
            x=x + width * i / cells,
            y=y,
            width=width / cells + 0.3,
            height=8,
            fill=palette.diverging(2 * (i + 0.5) / cells - 1),
        )
        for i in range(cells)
    )
    for fraction, anchor in ((0.0, "start"), (0.5, "middle"), (1.0, "end")):
        value = plain((2 * fraction - 1) * peak, 3)
        drawn += label(
            x + width * fraction, y + 20, value, text_anchor=anchor, fill=palette.MUTED, class_="tick"
        )
    words = t("bending moment, {unit}", unit=unit)
    return drawn + label(x + width + 10, y + 8, words, fill=palette.MUTED, class_="tick")
