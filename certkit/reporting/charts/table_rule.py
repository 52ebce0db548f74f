"""The lines of a drawn table, and the height of its rows."""

from __future__ import annotations

from certkit.reporting import palette
from certkit.reporting.svg import tag

ROW = 30.0
"""Height of a row in CSS pixels."""


def rule(y: float, width: float) -> str:
    """Draw the line above a row."""
    return tag("line", x1=0, x2=width, y1=y, y2=y, stroke=palette.LINE)
