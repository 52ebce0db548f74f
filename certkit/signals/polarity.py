"""Polarity: channels whose sign is known are checked, because a swapped wire looks like a good test."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

POSITIVE_CHANNELS = ("T1", "T2", "T3", "T4", "MCL")
"""Positive in pendulum and inverse tests: the tibia's impact side is in compression, the MCL gets longer.

Femur moments may have either sign there (inertia bends the femur back) and ACL and PCL are small, so they
are not checked.
"""

CLEAR = 1.5
"""How many times larger the wrong side must be before the sign counts as swapped."""


def is_swapped(values: NDArray[np.float64]) -> bool:
    """Tell whether a channel that should be positive first and foremost points the other way.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Samples after contact, offset removed.
    """
    return bool(
        values.size and -float(values.min()) > CLEAR * max(float(values.max()), 0.0) and values.min() < 0
    )
