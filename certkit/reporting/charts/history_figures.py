"""Channels over time as a figure of their own: of one result, or of two over each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.channel_order import ordered_channels
from certkit.reporting.charts.channel_history import history_chart
from certkit.reporting.charts.chosen import chosen
from certkit.reporting.charts.grid import together
from certkit.reporting.charts.lines import lines_chart

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result
    from certkit.reporting.svg import Drawing


def draw(result: Result, names: Sequence[str]) -> Drawing | None:
    """Draw a result's channels over time, all or those that are named."""
    curves = result.curves
    if curves is None or curves.count < 2:
        return None
    known = ordered_channels(result)
    drawings = [history_chart(curves, name, known[name]) for name in chosen(names, known)]
    return together(drawings, f"Time histories of {result.title}")


def draw_beside(result: Result, beside: Result, names: Sequence[str]) -> Drawing | None:
    """Draw the channels that two results both have, over each other."""
    first, second = result.curves, beside.curves
    if first is None or second is None:
        return None
    other = beside.procedure + (" (2)" if beside.procedure == result.procedure else "")
    drawn = []
    for name in chosen(names, [name for name in ordered_channels(result) if name in second.series]):
        one = first.series[name]
        lines = [
            (result.procedure, first.milliseconds, one.values),
            (other, second.milliseconds, second.series[name].values),
        ]
        drawn.append(lines_chart(lines, name, "ms", one.unit, width=360, height=210))
    return together(drawn, f"{result.title} and {beside.title}")
