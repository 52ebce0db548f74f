"""Rounding half up in decimals, as rating programmes print it and spreadsheets do it."""

from __future__ import annotations

import math
from decimal import ROUND_HALF_UP, Decimal

GUARD = 9
"""Decimals to which a binary number is brought first: 0.075, stored as 0.07499…, is 0.08 all the same."""


def half_up(value: float, decimals: int) -> float:
    """Round to a number of decimals; halves go away from zero (27.005 to 27.01), unlike Python's `round`.

    Parameters
    ----------
    value : float
        A value that is not finite comes back as it is.
    decimals : int
        0 or more.
    """
    if not math.isfinite(value):
        return value
    guarded = Decimal(value).quantize(Decimal(1).scaleb(-max(GUARD, decimals + 4)), rounding=ROUND_HALF_UP)
    return float(guarded.quantize(Decimal(1).scaleb(-decimals), rounding=ROUND_HALF_UP))


def band_borders(low: float, high: float, parts: int, decimals: int | None) -> list[float]:
    """Return the borders of `parts` equal bands between two values, rounded half up.

    With `low` and `high` among them: 27 mm to 32 mm in three bands is 27, 28.67, 30.33, 32.
    """
    width = (high - low) / parts
    borders = [low, *(low + width * i for i in range(1, parts)), high]
    return borders if decimals is None else [half_up(border, decimals) for border in borders]
