"""The frame of a plot: axes, grid, ticks and titles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting import palette
from certkit.reporting.number_format import plain
from certkit.reporting.scales import Scale, ticks
from certkit.reporting.svg import label, number, path, tag

if TYPE_CHECKING:
    from collections.abc import Iterable


class Frame(Struct, frozen=True):
    """The drawing area of a plot and its two scales."""

    width: float
    height: float
    x: Scale
    y: Scale

    @classmethod
    def around(
        cls,
        x: tuple[float, float],
        y: tuple[float, float],
        *,
        width: float = 360,
        height: float = 200,
        below: float = 22,
        above: float = 28,
    ) -> Frame:
        """Leave room for ticks and titles. The page's scripts know these numbers."""
        return cls(width, height, Scale(*x, 46, width - 14), Scale(*y, height - below, above))

    @property
    def left(self) -> float:
        """Left edge of the drawing area."""
        return self.x.start

    @property
    def right(self) -> float:
        """Right edge of the drawing area."""
        return self.x.end

    @property
    def top(self) -> float:
        """Upper edge of the drawing area."""
        return self.y.end

    @property
    def bottom(self) -> float:
        """Lower edge of the drawing area."""
        return self.y.start

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Return where a point lies on the picture."""
        return self.x(x), self.y(y)

    def axes(self, title: str, x_title: str, y_unit: str, *, numbered: bool = True) -> str:
        """Draw the grid, the zero line, both axes' ticks and the titles.

        A short title of the abscissa (a unit) stands in line with its ticks, a long one below them. An
        abscissa that is not `numbered` has no ticks.
        """
        # Like marks share one path and one group: a suite has a hundred plots, and so each byte counts.
        heights = ticks(self.y.low, self.y.high, 6)
        grid = "".join(f"M{number(self.left)} {number(self.y(v))}H{number(self.right)}" for v in heights if v)
        drawn = [tag("path", d=grid, stroke=palette.GRID, stroke_width=0.8, class_="grid")] if grid else []
        if 0 in heights:
            drawn.append(self._rule(self.y(0), 0.8))
        labels = "".join(label(self.left - 6, self.y(v) + 3.6, plain(v)) for v in heights)
        drawn.append(tag("g", labels, class_="tick", fill=palette.MUTED, text_anchor="end"))
        places = ticks(self.x.low, self.x.high, 7)
        marks = "".join(f"M{number(self.x(v))} {number(self.bottom)}v4" for v in places)
        numbers = "".join(label(self.x(v), self.bottom + 15, plain(v)) for v in places)
        marked = tag("path", d=marks, stroke=palette.MUTED, class_="zero") if marks else ""
        if numbered:
            ticked = marked + numbers
            drawn.append(tag("g", ticked, class_="xticks tick", fill=palette.MUTED, text_anchor="middle"))
        drawn.append(self._rule(self.bottom, 1.0))
        drawn.append(label(6, 14, title, font_weight="600", class_="title"))
        drawn.append(label(self.right, 14, y_unit, text_anchor="end", fill=palette.MUTED, class_="tick unit"))
        short = len(x_title) < 4
        drawn.append(
            label(
                self.left - 6 if short else self.right,
                self.bottom + 15 if short else self.height - 4,
                x_title,
                text_anchor="end",
                fill=palette.MUTED,
                class_="tick",
            )
        )
        return "".join(drawn)

    def corridor(self, low: float, high: float) -> str:
        """Shade what lies between two ordinates."""
        return tag(
            "rect",
            x=self.left,
            y=self.y(high),
            width=self.right - self.left,
            height=self.y(low) - self.y(high),
            fill=palette.CORRIDOR,
            class_="corridor",
        )

    def area(self, polygon: Iterable[tuple[float, float]]) -> str:
        """Shade the area that a curve has to stay in."""
        return tag(
            "path",
            d=path((self.place(*point) for point in polygon), closed=True),
            fill=palette.CORRIDOR,
            stroke=palette.CORRIDOR_EDGE,
            stroke_dasharray="5 3",
            class_="corridor limit",
        )

    def _rule(self, y: float, width: float) -> str:
        return tag(
            "line",
            x1=self.left,
            x2=self.right,
            y1=y,
            y2=y,
            stroke=palette.MUTED,
            stroke_width=width,
            class_="zero",
        )
