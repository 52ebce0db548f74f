"""`min`: the lowest value of a channel, and when it first occurs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.grading.measures.measure_method import PeakMethod

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Min(PeakMethod):
    """min y(t)."""

    def turned(self, ordinates: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return −y, of the same shape and unit."""
        return -ordinates
