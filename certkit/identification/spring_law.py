"""The law of a spring between two groups: loading curve, unloading branch, permanent set, damping.

The same law stands in a vehicle document and is simulated by the mechanics room (`VehicleSpring`); a test
holds the two against each other. For shortening x with largest shortening so far xm and Fm = B(xm):

- loading (x ≥ xm): F = B(x), piecewise linear, continued with its last slope;
- unloading and reloading (x < xm): F = max(Fm − k·(xm − x), r·Fm·(x − xs)/(xm − xs), 0), never above B(x),
  with the unloading stiffness k, the residual share r and the permanent set xs = s·xm;
- extension, for a path that can pull: the same with the loading curve's negative part, measured from the
  length that the shortening has left behind;
- damping: c·dx/dt while the spring is engaged; a path that cannot pull never pulls by its damper either.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    Values = NDArray[np.float64]
    Curve = Callable[[Values], Values]


class Branch(Struct, frozen=True):
    """How a spring unloads.

    Parameters
    ----------
    stiffness : float
        Unloading stiffness k in N/m.
    residual : float
        Share r of the largest force that the lower branch aims at, 0 to 1.
    permanent_set : float
        Share s of the largest shortening that stays, 0 to 1.
    """

    stiffness: float
    residual: float = 0.0
    permanent_set: float = 0.0


class SpringLaw(Struct, frozen=True):
    """Law of one path. SI units.

    Parameters
    ----------
    shortening, force : tuple of float
        Points of the loading curve; shortenings rise. Points below zero shortening are the pulling side.
    branch : Branch
        Unloading.
    damping : float
        N·s/m.
    tension : bool
        Whether it can pull.
    """

    shortening: tuple[float, ...]
    force: tuple[float, ...]
    branch: Branch
    damping: float = 0.0
    tension: bool = False

    def loading(self, x: Values) -> Values:
        """Return the loading curve, N, at shortenings x ≥ 0, m, shape (n,).

        It is continued with its last slope, never a falling one.
        """
        return _continued(x, *self._side(+1.0))

    def pulling(self, y: Values) -> Values:
        """Return the pulling force (positive), N, at extensions y ≥ 0, m, shape (n,)."""
        return _continued(y, *self._side(-1.0))

    def _side(self, sign: float) -> tuple[Values, Values]:
        x, f = sign * np.array(self.shortening), sign * np.array(self.force)
        x, f = (x, f) if sign > 0 else (x[::-1], f[::-1])
        keep = x >= 0
        x, f = x[keep], f[keep]
        if x.size == 0 or x[0] > 0:
            x, f = np.concatenate([[0.0], x]), np.concatenate([[0.0], f])
        return x, f

    def _highest(self, sign: float) -> Curve:
        """Return the largest force of a side's loading curve up to a shortening."""
        xs, fs = self._side(sign)
        if xs.size < 2:
            return np.zeros_like
        tops = np.maximum.accumulate(fs)

        def highest(x: Values) -> Values:
            before = tops[np.maximum(np.searchsorted(xs, x, side="right") - 1, 0)]
            return np.maximum(before, _continued(x, xs, fs))

        return highest

    def spring_force(self, x: Values) -> Values:
        """Return the force of the spring alone, N, along a history of shortenings x, m, shape (n,)."""
        side = _history(np.maximum(x, 0.0), self.loading, self.branch, self._highest(+1.0))
        if not self.tension:
            return side
        y = np.maximum(self.rest_length(np.maximum(x, 0.0)) - x, 0.0)
        pull = _history(y, self.pulling, self.branch, self._highest(-1.0))
        return np.where(y > 0, -pull, side)

    def rest_length(self, x: Values) -> Values:
        """Return the shortening, m, at which unloading comes to zero force, along x ≥ 0, m, shape (n,).

        With the largest shortening X so far it is s·X where a residual force is kept (permanent set s), else
        X − F(X)/k with the unloading stiffness k.
        """
        top = np.maximum.accumulate(x)
        if self.branch.residual > 0:
            return self.branch.permanent_set * top
        return np.maximum(top - self.loading(top) / self.branch.stiffness, 0.0)

    def total_force(self, x: Values, v: Values) -> Values:
        """Return spring and damper, F(x) + c·v in N, along shortenings x (m) and rates v (m/s), shape (n,).

        A spring that only pushes gives nothing while it does not push, and never pulls.
        """
        spring = self.spring_force(x)
        if self.tension:
            return spring + self.damping * v
        return np.where(spring > 0, np.maximum(spring + self.damping * v, 0.0), 0.0)


def _continued(x: Values, xs: Values, fs: Values) -> Values:
    if xs.size < 2:
        return np.zeros_like(x)
    slope = max((fs[-1] - fs[-2]) / (xs[-1] - xs[-2]), 0.0)
    return np.asarray(np.interp(x, xs, fs) + slope * np.maximum(x - xs[-1], 0.0))


def _history(x: Values, loading: Curve, branch: Branch, highest: Curve) -> Values:
    """Force along a history of x ≥ 0 with the memory of its largest value."""
    top = np.maximum.accumulate(x)
    peak = loading(top)
    steep = peak - branch.stiffness * (top - x)
    rest = branch.permanent_set * top
    span = np.maximum(top - rest, 1e-12)
    flat = branch.residual * peak * np.maximum(x - rest, 0.0) / span
    lower = np.maximum(np.maximum(steep, flat), 0.0)
    return np.where(x >= top, peak, np.minimum(lower, highest(x)))
