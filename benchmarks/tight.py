"""The bone chain in one tight compiled loop without pymunk: the same method on plain arrays.

Leapfrog with the joints' springs, pivots by sequential impulses with warm start: what pymunk does, without
its spaces, arbiters and callbacks. It is what a solver written for this chain alone could do.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numba import njit

from certkit.mechanics.solver.pymunk_space import ITERATIONS

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from support.chain_oracle import Chain

CLOSING = 691.0  # 1/s: as pymunk closes gaps with the error bias that our solver gives it


def tight_chain(
    chain: Chain, q: NDArray[np.float64], v: NDArray[np.float64], step: float, until: float, every: int
) -> NDArray[np.float64]:
    """Return the elastic joint moments every `every` steps, shape (t, joints)."""
    centres, jacobian = chain.centres(q)
    pose = np.column_stack([centres, q[2:]])
    rate = np.column_stack([jacobian @ v, v[2:]])
    out = np.zeros((round(until / step) // every + 1, chain.links - 1))
    _march(
        pose, rate, chain.mass, chain.inertia, chain.arm, chain.length - chain.arm, chain.stiffness,
        chain.damping, step, every, out,
    )  # fmt: skip
    return out


@njit(cache=True, error_model="numpy")
def _march(pose, rate, mass, inertia, up, down, stiffness, damping, step, every, out):  # noqa: ANN001, ANN202, PLR0913, PLR0917  # compiled
    n = mass.shape[0]
    last = rate.copy()
    moment = np.zeros(n - 1)
    impulse = np.zeros((n - 1, 2))
    arms = np.zeros((n - 1, 4))
    inverse = np.zeros((n - 1, 3))
    pose -= 0.5 * step * rate
    length = 0.5 * step
    for k in range(every * (out.shape[0] - 1) + 1):
        if k == 1:
            length = step
        pose += length * rate
        for j in range(n - 1):
            bend = pose[j + 1, 2] - pose[j, 2]
            if k % every == 0:
                out[k // every, j] = stiffness[j] * bend
            turn = rate[j + 1, 2] - rate[j, 2]
            before = last[j + 1, 2] - last[j, 2]
            moment[j] = stiffness[j] * bend + damping[j] * (turn + (0.5 if k > 1 else 0.0) * (turn - before))
        last[:] = rate
        for j in range(n - 1):
            rate[j, 2] += length * moment[j] / inertia[j]
            rate[j + 1, 2] -= length * moment[j] / inertia[j + 1]
        for j in range(n - 1):
            ax, az = down[j] * math.sin(pose[j, 2]), -down[j] * math.cos(pose[j, 2])
            bx, bz = -up[j + 1] * math.sin(pose[j + 1, 2]), up[j + 1] * math.cos(pose[j + 1, 2])
            arms[j] = ax, az, bx, bz
            light = 1 / mass[j] + 1 / mass[j + 1]
            a, b = 1 / inertia[j], 1 / inertia[j + 1]
            kxx = light + az * az * a + bz * bz * b
            kxz = -ax * az * a - bx * bz * b
            kzz = light + ax * ax * a + bx * bx * b
            determinant = kxx * kzz - kxz * kxz
            inverse[j] = kzz / determinant, -kxz / determinant, kxx / determinant
            _push(rate, mass, inertia, arms, j, impulse[j, 0], impulse[j, 1])
        for _ in range(ITERATIONS):
            for j in range(n - 1):
                ax, az, bx, bz = arms[j]
                # The gap's speed, and what closes the gap itself.
                gx = pose[j + 1, 0] + bx - pose[j, 0] - ax
                gz = pose[j + 1, 1] + bz - pose[j, 1] - az
                vx = rate[j + 1, 0] - rate[j + 1, 2] * bz - rate[j, 0] + rate[j, 2] * az + CLOSING * gx
                vz = rate[j + 1, 1] + rate[j + 1, 2] * bx - rate[j, 1] - rate[j, 2] * ax + CLOSING * gz
                px = -(inverse[j, 0] * vx + inverse[j, 1] * vz)
                pz = -(inverse[j, 1] * vx + inverse[j, 2] * vz)
                impulse[j, 0] += px
                impulse[j, 1] += pz
                _push(rate, mass, inertia, arms, j, px, pz)


@njit(inline="always")
def _push(rate, mass, inertia, arms, j, px, pz):  # noqa: ANN001, ANN202  # compiled
    ax, az, bx, bz = arms[j]
    rate[j, 0] -= px / mass[j]
    rate[j, 1] -= pz / mass[j]
    rate[j, 2] -= (ax * pz - az * px) / inertia[j]
    rate[j + 1, 0] += px / mass[j + 1]
    rate[j + 1, 1] += pz / mass[j + 1]
    rate[j + 1, 2] += (bx * pz - bz * px) / inertia[j + 1]
