"""Several figures on one sheet, in columns."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from certkit.reporting.svg import number, picture

if TYPE_CHECKING:
    from collections.abc import Sequence

_SIZE = re.compile(r'width="([\d.]+)" height="([\d.]+)"')
GAP = 16.0


def sheet(drawings: Sequence[str], title: str, *, columns: int = 2) -> str:
    """Put drawn figures side by side, row by row, into one picture."""
    columns = max(1, min(columns, len(drawings)))
    sizes = [_size(drawing) for drawing in drawings]
    widths = [max((w for w, _ in sizes[c::columns]), default=0.0) for c in range(columns)]
    placed, y = [], 0.0
    for start in range(0, len(drawings), columns):
        x = 0.0
        for column, drawing in enumerate(drawings[start : start + columns]):
            head = f'<svg x="{number(x)}" y="{number(y)}" '
            placed.append(drawing.replace("<svg ", head, 1))
            x += widths[column] + GAP
        y += max(h for _, h in sizes[start : start + columns]) + GAP
    width = sum(widths) + GAP * (columns - 1)
    return picture(width, max(y - GAP, 1.0), "".join(placed), title)


def _size(drawing: str) -> tuple[float, float]:
    match = _SIZE.search(drawing)
    return (float(match.group(1)), float(match.group(2))) if match else (360.0, 200.0)
