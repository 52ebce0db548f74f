"""Polarity: channels whose sign is known are checked, because a swapped wire looks like a good test.

A legform names them: in pendulum and inverse tests of the Flex-PLI the tibia's impact side is in compression
and the MCL gets longer.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

CLEAR = 1.5
"""How many times larger the wrong side must be before the sign counts as swapped."""
LOUD = 0.01
"""Share of the amplitude class that it must exceed as well (4 N·m, 0.3 mm)."""


def is_swapped(values: NDArray[np.float64], sign: int = 1, *, least: float = 0.0) -> bool:
    """Tell whether a channel points the other way.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Samples after contact, in the channel's unit, offset removed.
    sign : {1, -1, 0}
        What the channel should be first and foremost; 0 where it may be either, which is never swapped.
    least : float
        Size that the wrong side has to exceed; what is smaller is noise and has no sign.
    """
    if not values.size or sign == 0:
        return False
    right, wrong = (float(values.max()), -float(values.min()))[::sign]
    return wrong > CLEAR * max(right, 0.0) and wrong > least
