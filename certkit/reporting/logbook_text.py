"""The overview of a legform for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import number_format as words
from certkit.reporting.plaintext import aligned

if TYPE_CHECKING:
    from certkit.documents.logbook_overview import LegOverview, Trend


def overview_text(leg: LegOverview) -> str:
    """Return state, validity, tests and trends as plain text."""
    counts = ", ".join(f"{count} × {name}" for name, count in leg.counts.items())
    parts = [f"Legform {leg.serial} on {leg.day}: {leg.state}\n{len(leg.tests)} tests: {counts}"]
    rows = [
        (
            line.state,
            line.title,
            f"due {line.due}" if line.due else "" if line.left is None else f"{line.left} tests left",
            line.why,
            line.confidence,
        )
        for line in leg.validity
    ]
    parts.append(aligned(("state", "rule", "left", "why", "rule is"), rows))
    heads = ("procedure", "criterion", "n", "mean", "s", "%CV", "unit", "control limits", "drift a year", "")
    parts.append(aligned(heads, [_row(trend) for trend in leg.trends], right=(2, 3, 4, 5, 8)))
    return "\n\n".join(parts)


def _row(trend: Trend) -> tuple[str, ...]:
    limits = (
        ""
        if trend.control_lower is None
        else " – ".join(words.shown(v, trend.unit) for v in (trend.control_lower, trend.control_upper))
    )
    left = f"leaves its corridor on {trend.leaves}" if trend.leaves else trend.remark
    return (
        trend.procedure,
        trend.criterion,
        str(trend.count),
        words.shown(trend.mean, trend.unit),
        words.plain(trend.standard_deviation, 3),
        words.fixed(trend.variation_percent, 1),
        trend.unit,
        limits,
        words.plain(trend.slope_per_year, 3) if trend.drifts else "",
        left,
    )
