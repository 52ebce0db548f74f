"""The small bar that shows where a value lies in its corridor, with its uncertainty and spread."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.number_format import corridor, fixed, verdict_class
from certkit.reporting.scales import Scale
from certkit.reporting.svg import Drawing, path, tag

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult

WIDTH, HEIGHT = 148.0, 26.0
_MIDDLE = HEIGHT / 2 + 2
_LEFT, _RIGHT = 8.0, WIDTH - 8.0


def _range(criterion: CriterionResult) -> tuple[float, float] | None:
    lower, upper = criterion.lower, criterion.upper
    if lower is not None and upper is not None:
        half = (upper - lower) / 2 or abs(upper) * 0.1 or 1.0
        return lower - half, upper + half
    if upper is not None:
        return (0.0, upper * 4 / 3) if upper > 0 else (upper - 1, upper + 0.5)
    if lower is not None:
        return (lower * 2 / 3, lower * 4 / 3) if lower > 0 else (lower - 0.5, lower + 1)
    return None


def position_bar(criterion: CriterionResult, decimals: int) -> Drawing | None:
    """Draw it, or return None where there is no value or no scalar corridor.

    The corridor fills the middle half of the bar. A value beyond the bar's ends becomes an arrow at the end.
    """
    bounds = _range(criterion)
    value = criterion.value
    if bounds is None or value is None or not math.isfinite(value):
        return None
    scale = Scale(*bounds, _LEFT, _RIGHT)
    start = scale(criterion.lower) if criterion.lower is not None else _LEFT
    end = scale(criterion.upper) if criterion.upper is not None else _RIGHT
    drawn = [
        tag(
            "rect", x=_LEFT, y=_MIDDLE - 4, width=_RIGHT - _LEFT, height=8, fill=palette.GRID, class_="track"
        ),
        tag(
            "rect",
            x=start,
            y=_MIDDLE - 4,
            width=end - start,
            height=8,
            fill=palette.CORRIDOR,
            class_="corridor",
        ),
    ]
    guard = criterion.uncertainty.guard_band if criterion.uncertainty else None
    if guard:
        width = abs(scale(guard) - scale(0.0))
        edges = [start] if criterion.lower is not None else []
        edges += [end - width] if criterion.upper is not None else []
        drawn += [
            tag("rect", x=x, y=_MIDDLE - 4, width=width, height=8, fill=palette.GUARD, class_="guard")
            for x in edges
        ]
    drawn += [
        tag("line", x1=x, x2=x, y1=_MIDDLE - 6, y2=_MIDDLE + 6, stroke=palette.CORRIDOR_EDGE, class_="limit")
        for x, limit in ((start, criterion.lower), (end, criterion.upper))
        if limit is not None
    ]
    drawn += [_whisker(scale, *pair) for pair in _intervals(criterion)]
    drawn.append(_pointer(scale(value), palette.VERDICT[criterion.verdict], criterion.verdict))
    words = f"{fixed(value, decimals)} {criterion.unit}; {corridor(criterion.lower, criterion.upper)}"
    return Drawing(WIDTH, HEIGHT, "".join(drawn), words, css_class="bar")


def _intervals(criterion: CriterionResult) -> list[tuple[float, float]]:
    pairs = []
    if criterion.uncertainty and criterion.uncertainty.expanded and criterion.value is not None:
        reach = criterion.uncertainty.expanded
        pairs.append((criterion.value - reach, criterion.value + reach))
    if criterion.spread:
        pairs.append((criterion.spread.minimum, criterion.spread.maximum))
    return pairs


def _whisker(scale: Scale, low: float, high: float) -> str:
    left, right = (min(_RIGHT, max(_LEFT, scale(v))) for v in (low, high))
    return tag(
        "line", x1=left, x2=right, y1=_MIDDLE, y2=_MIDDLE, stroke=palette.INK, stroke_width=1.4, class_="ink"
    )


def _pointer(x: float, colour: str, verdict: str) -> str:
    """Draw a stem with a head; an arrow where the value lies beyond the bar."""
    css = verdict_class(verdict)
    if x < _LEFT or x > _RIGHT:
        tip, back = (1.0, 7.0) if x < _LEFT else (WIDTH - 1, WIDTH - 7)
        head = [(tip, _MIDDLE), (back, _MIDDLE - 5.5), (back, _MIDDLE + 5.5)]
        return tag("path", d=path(head, closed=True), fill=colour, class_=css)
    head = [(x, _MIDDLE - 4), (x - 4.5, _MIDDLE - 12), (x + 4.5, _MIDDLE - 12)]
    return tag("path", d=path(head, closed=True), fill=colour, class_=css) + tag(
        "line", x1=x, x2=x, y1=_MIDDLE - 6, y2=_MIDDLE + 6, stroke=colour, stroke_width=2, class_=css
    )
