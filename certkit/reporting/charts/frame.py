"""The frame of a plot: axes, grid, ticks and titles."""

from __future__ import annotations

from dataclasses import dataclass

from certkit.reporting import palette
from certkit.reporting.scales import Scale, ticks
from certkit.reporting.svg import label, tag
from certkit.reporting.words import plain


@dataclass(frozen=True)
class Frame:
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
        return cls(width, height, Scale(*x, 46, width - 12), Scale(*y, height - below, above))

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

    def axes(self, title: str, x_title: str, y_unit: str) -> str:
        """Draw the grid, the zero line, both axes' ticks and the titles.

        A short title of the abscissa (a unit) stands in line with its ticks, a long one below them.
        """
        drawn = []
        for value in ticks(self.y.low, self.y.high, 6):
            y = self.y(value)
            zero = value == 0
            drawn.append(
                tag(
                    "line",
                    x1=self.left,
                    x2=self.right,
                    y1=y,
                    y2=y,
                    stroke=palette.MUTED if zero else palette.GRID,
                    stroke_width=0.8,
                    class_="zero" if zero else "grid",
                )
            )
            drawn.append(
                label(
                    self.left - 6, y + 3.6, plain(value), text_anchor="end", fill=palette.MUTED, class_="tick"
                )
            )
        marks = []
        for value in ticks(self.x.low, self.x.high, 7):
            x = self.x(value)
            marks.append(
                tag(
                    "line",
                    x1=x,
                    x2=x,
                    y1=self.bottom,
                    y2=self.bottom + 4,
                    stroke=palette.MUTED,
                    class_="zero",
                )
                + label(
                    x, self.bottom + 15, plain(value), text_anchor="middle", fill=palette.MUTED, class_="tick"
                )
            )
        drawn.append(tag("g", "".join(marks), class_="xticks"))
        drawn.append(
            tag(
                "line",
                x1=self.left,
                x2=self.right,
                y1=self.bottom,
                y2=self.bottom,
                stroke=palette.MUTED,
                class_="zero",
            )
        )
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
