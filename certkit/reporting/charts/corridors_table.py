"""All criteria in their corridors, drawn as a table for slides."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.position import HEIGHT, position_bar
from certkit.reporting.charts.table_rule import ROW, rule
from certkit.reporting.number_format import SIGNS, corridor, criterion_decimals, fixed, named
from certkit.reporting.svg import Drawing, label

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result


def draw(result: Result, names: Sequence[str]) -> Drawing:
    """Draw the figure of a result; it shows all criteria, whatever is named."""
    del names
    return corridors_table(result)


def corridors_table(result: Result) -> Drawing:
    """Draw each criterion with its value, corridor, and the bar that shows where it lies."""
    rows = result.criteria
    width, height = 640.0, 40 + ROW * len(rows)
    drawn = label(6, 16, f"{result.title}: {result.verdict}", font_weight="600", font_size="13")
    for index, criterion in enumerate(rows):
        middle = 40 + ROW * index + ROW / 2
        decimals = criterion_decimals(criterion)
        drawn += rule(middle - ROW / 2, width)
        drawn += label(6, middle + 4, named(criterion.id, criterion.title), font_weight="600")
        value = f"{fixed(criterion.value, decimals)} {criterion.unit}"
        drawn += label(270, middle + 4, value, text_anchor="end")
        drawn += label(
            290, middle + 4, corridor(criterion.lower, criterion.upper), fill=palette.MUTED, class_="tick"
        )
        bar = position_bar(criterion, decimals)
        if bar:
            drawn += bar.svg(x=380, y=middle - HEIGHT / 2 - 2)
        words = f"{SIGNS[criterion.verdict]} {criterion.verdict}" if criterion.graded else "shown only"
        colour = palette.VERDICT[criterion.verdict] if criterion.graded else palette.MUTED
        drawn += label(545, middle + 4, words, font_weight="600" if criterion.graded else None, fill=colour)
    return Drawing(width, height, drawn, f"Criteria of {result.title} in their corridors")
