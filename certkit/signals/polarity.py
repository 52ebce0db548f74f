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


def is_swapped(values: NDArray[np.float64], sign: int = 1) -> bool:
    """Tell whether a channel points the other way.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Samples after contact, offset removed.
    sign : {1, -1, 0}
        What the channel should be first and foremost; 0 where it may be either, which is never swapped.
    """
    if not values.size or sign == 0:
        return False
    right, wrong = (float(values.max()), -float(values.min()))[::sign]
    return wrong > CLEAR * max(right, 0.0) and wrong > 0
