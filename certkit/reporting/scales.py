"""From values to places on paper: linear scales and round tick marks."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Iterable


class Scale(Struct, frozen=True):
    """A linear map of the values `low`…`high` to the places `start`…`end`."""

    low: float
    high: float
    start: float
    end: float

    def __call__(self, value: float) -> float:
        """Return the place of a value."""
        return self.start + (value - self.low) / (self.high - self.low) * (self.end - self.start)


def span(values: Iterable[float | None], *, margin: float = 0.06) -> tuple[float, float]:
    """Return the range of finite values with some room around, never empty."""
    finite = [v for v in values if v is not None and math.isfinite(v)]
    low, high = (min(finite), max(finite)) if finite else (0.0, 1.0)
    if high - low <= 1e-12 * max(abs(low), abs(high), 1e-300):
        pad = abs(low) * 0.1 or 1.0
        return low - pad, high + pad
    room = (high - low) * margin
    return low - room, high + room


def ticks(low: float, high: float, most: int = 6) -> list[float]:
    """Return round values between `low` and `high`, `most` at the most."""
    raw = (high - low) / max(most - 1, 1)
    power = 10 ** math.floor(math.log10(raw))
    step = next(factor * power for factor in (1, 2, 2.5, 5, 10) if factor * power >= raw * 0.999)
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [0.0 if index == 0 else float(f"{index * step:.12g}") for index in range(first, last + 1)]


def traced(points: list[tuple[float, float]], most: int = 120) -> list[tuple[float, float]]:
    """Return fewer points of a line: `thinned` for a history, evenly chosen for a curve that turns back."""
    if all(a[0] <= b[0] for a, b in pairwise(points)):
        return thinned(points, most)
    stride = max(1, len(points) // most)
    return [*points[:-1:stride], points[-1]]


def thinned(points: list[tuple[float, float]], most: int = 120) -> list[tuple[float, float]]:
    """Return at most about `most` of the points, with the lowest and highest of each stretch among them."""
    if len(points) <= most:
        return points
    stretch = len(points) / (most // 2)
    kept: list[tuple[float, float]] = [points[0]]
    for index in range(most // 2):
        part = points[int(index * stretch) : int((index + 1) * stretch)]
        ends = sorted({min(part, key=lambda p: p[1]), max(part, key=lambda p: p[1])})
        kept += [point for point in ends if point != kept[-1]]
    if kept[-1] != points[-1]:
        kept.append(points[-1])
    return kept
