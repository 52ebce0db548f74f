"""Tables drawn as figures, for slides: criteria in their corridors, and the error table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.position import HEIGHT, position_bar
from certkit.reporting.number_format import SIGNS, corridor, criterion_decimals, fixed, named, shown
from certkit.reporting.svg import Drawing, label, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Comparison, Result

ROW = 30.0


def corridors_table(result: Result) -> Drawing:
    """Draw each criterion with its value, corridor, and the bar that shows where it lies."""
    rows = result.criteria
    width, height = 640.0, 40 + ROW * len(rows)
    drawn = label(6, 16, f"{result.title}: {result.verdict}", font_weight="600", font_size="13")
    for index, criterion in enumerate(rows):
        middle = 40 + ROW * index + ROW / 2
        decimals = criterion_decimals(criterion)
        drawn += _rule(middle - ROW / 2, width)
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


def errors_table(comparison: Comparison) -> Drawing:
    """Draw the error table as the paper prints it: channels across, test, simulations and errors down."""
    published = any(row.published is not None for row in comparison.rows)
    lines: list[tuple[str, Sequence[str]]] = [
        (f"Test, {comparison.rows[0].unit}", [shown(r.test, r.unit) for r in comparison.rows]),
        ("This simulation", [shown(r.simulation, r.unit) for r in comparison.rows]),
        ("Error, %", [_signed(r.error_percent) for r in comparison.rows]),
    ]
    if published:
        lines += [
            (
                "Published simulation",
                [shown(r.published, r.unit) if r.published is not None else "–" for r in comparison.rows],
            ),
            ("Its error, %", [_signed(r.published_error_percent) for r in comparison.rows]),
        ]
    totals = {
        "Error, %": comparison.rms_error_percent,
        "Its error, %": comparison.published_rms_error_percent,
    }
    first, cell = 150.0, 66.0
    width = first + cell * (len(comparison.rows) + 1)
    drawn = label(6, 16, comparison.title or comparison.reference, font_weight="600", font_size="13")
    heads = [row.channel for row in comparison.rows] + ["rms"]
    for index, head in enumerate(heads):
        drawn += label(first + cell * (index + 1) - 12, 44, head, text_anchor="end", font_weight="600")
    for index, (name, cells) in enumerate(lines):
        y = 52 + ROW * index
        drawn += _rule(y, width) + label(6, y + 19, name)
        total = totals.get(name)
        for place, words in enumerate([*cells, fixed(total, 1) if total is not None else ""]):
            drawn += label(first + cell * (place + 1) - 12, y + 19, words, text_anchor="end")
    height = 52 + ROW * len(lines) + 2
    drawn += _rule(height - 2, width)
    return Drawing(width, height, drawn, f"Error table against {comparison.reference}")


def _signed(value: float | None) -> str:
    return ("+" if value is not None and value > 0 else "") + fixed(value, 1)


def _rule(y: float, width: float) -> str:
    return tag("line", x1=0, x2=width, y1=y, y2=y, stroke=palette.LINE)
