"""Energy of a load path over its history: what was put in, what came back, what stayed.

Along a history of shortening x(t) the path has taken up W(t) = ∫F dx. The most of it, max W, was put in; what
is left at the end, W(t_end), was absorbed; the difference came back and lets the groups rebound.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Values = NDArray[np.float64]


class PathEnergy(NamedTuple):
    """Energy put in and absorbed, J."""

    put_in: float
    absorbed: float


def path_energy(x: Values, force: Values) -> PathEnergy:
    """Return the energies of a history of shortening (m) and force (N), shape (n,), by trapezoids."""
    taken = np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(x))
    return PathEnergy(max(0.0, float(np.max(taken))), float(taken[-1]))
