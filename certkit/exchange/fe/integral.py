"""The running integral of a history: impulse from force, displacement from velocity."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


def running_integral(values: NDArray[np.float64], time: NDArray[np.float64]) -> NDArray[np.float64]:
    """Integrate values of shape (n,), their unit times s, from the first instant on by trapezoids.

    That is scipy's `cumulative_trapezoid`, whose import takes longer than to read most runs. `time`, s, has
    the shape (n,).
    """
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(time)
    return np.concatenate([[0.0], np.cumsum(steps)])
