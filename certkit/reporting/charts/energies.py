"""Energies over time: what the impact became."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.reporting.charts.lines import lines_chart
from certkit.reporting.language import english

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Histories, Result
    from certkit.reporting.language import Translate
    from certkit.reporting.svg import Drawing


def draw(result: Result, names: Sequence[str]) -> Drawing | None:
    """Draw the figure of a result; None where it holds no energies."""
    del names
    return energies_chart(result.energies) if result.energies else None


def energies_chart(energies: Histories, *, t: Translate = english) -> Drawing | None:
    """Draw where the energy went; forms that stay under a hundredth of the largest are named, not drawn."""
    if energies.count < 2 or not energies.series:
        return None
    axis = energies.milliseconds
    sizes = {
        name: max((abs(v) for v in series.values), default=0.0) for name, series in energies.series.items()
    }
    least = 0.01 * max(sizes.values())
    lines = [(s.title, axis, s.values) for name, s in energies.series.items() if sizes[name] >= least]
    small = [s.title for name, s in energies.series.items() if sizes[name] < least]
    title = t("Energy")
    drawing = lines_chart(lines, title, "ms", next(iter(energies.series.values())).unit)
    note = t("under one hundredth of the largest and not drawn: {names}", names=", ".join(small))
    return replace(drawing, title=f"{note}; {drawing.title}") if small else drawing
