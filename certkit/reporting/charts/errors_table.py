"""The error table against a reference, drawn as the paper prints it, for slides."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.charts.table_rule import ROW, rule
from certkit.reporting.number_format import fixed, shown, signed
from certkit.reporting.svg import Drawing, label

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Comparison, Result


def draw(result: Result, names: Sequence[str]) -> Drawing | None:
    """Draw the figure of a result; None where it was compared with nothing."""
    del names
    comparison = result.comparison
    return errors_table(comparison) if comparison and comparison.rows else None


def errors_table(comparison: Comparison) -> Drawing:
    """Draw the error table as the paper prints it: channels across, test, simulations and errors down."""
    published = any(row.published is not None for row in comparison.rows)
    lines: list[tuple[str, Sequence[str]]] = [
        (f"Test, {comparison.rows[0].unit}", [shown(r.test, r.unit) for r in comparison.rows]),
        ("This simulation", [shown(r.simulation, r.unit) for r in comparison.rows]),
        ("Error, %", [signed(r.error_percent, 1) for r in comparison.rows]),
    ]
    if published:
        lines += [
            (
                "Published simulation",
                [shown(r.published, r.unit) if r.published is not None else "–" for r in comparison.rows],
            ),
            ("Its error, %", [signed(r.published_error_percent, 1) for r in comparison.rows]),
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
        drawn += rule(y, width) + label(6, y + 19, name)
        total = totals.get(name)
        for place, words in enumerate([*cells, fixed(total, 1) if total is not None else ""]):
            drawn += label(first + cell * (place + 1) - 12, y + 19, words, text_anchor="end")
    height = 52 + ROW * len(lines) + 2
    drawn += rule(height - 2, width)
    return Drawing(width, height, drawn, f"Error table against {comparison.reference}")
