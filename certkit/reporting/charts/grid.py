"""Several figures in one drawing, in columns."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.svg import Drawing

if TYPE_CHECKING:
    from collections.abc import Sequence

GAP = 16.0


def side_by_side(drawings: Sequence[Drawing], title: str, *, columns: int = 2) -> Drawing:
    """Put drawn figures side by side, row by row, into one drawing."""
    columns = max(1, min(columns, len(drawings)))
    widths = [max((d.width for d in drawings[c::columns]), default=0.0) for c in range(columns)]
    placed, y = [], 0.0
    for start in range(0, len(drawings), columns):
        row, x = drawings[start : start + columns], 0.0
        for column, drawing in enumerate(row):
            placed.append(drawing.svg(x=x, y=y))
            x += widths[column] + GAP
        y += max(drawing.height for drawing in row) + GAP
    return Drawing(sum(widths) + GAP * (columns - 1), max(y - GAP, 1.0), "".join(placed), title)


def together(drawings: Sequence[Drawing], title: str) -> Drawing | None:
    """Return one drawing as it is, several side by side, and None where there is none."""
    if len(drawings) < 2:
        return drawings[0] if drawings else None
    return side_by_side(drawings, title)
