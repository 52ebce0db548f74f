"""How far a criterion lies inside its corridor, as a share: the one measure of what is nearest to a limit."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult


def relative_margin(criterion: CriterionResult) -> float | None:
    """Return the margin as a share of half the corridor, or of the limit where there is only one."""
    margin = criterion.margin
    if margin is None or not math.isfinite(margin):
        return None
    if criterion.lower is not None and criterion.upper is not None:
        size = (criterion.upper - criterion.lower) / 2
    else:
        size = abs(criterion.upper if criterion.upper is not None else criterion.lower or 0.0)
    return margin / size if size > 0 else None
