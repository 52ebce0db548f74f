"""In which order a result's channels are drawn, and for which criterion."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult, Result


def ordered_channels(result: Result) -> dict[str, CriterionResult | None]:
    """Return the channels to draw: those of criteria first, in the criteria's order, then the others."""
    if result.curves is None:
        return {}
    series = result.curves.series
    chosen: dict[str, CriterionResult | None] = {}
    for criterion in result.criteria:
        if criterion.channel in series and (criterion.channel not in chosen):
            chosen[criterion.channel] = criterion
    return chosen | {name: None for name in series if name not in chosen}
