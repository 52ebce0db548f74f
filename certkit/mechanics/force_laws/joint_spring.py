"""Rotational spring and damper between two bodies, stiffening where the steel cables come tight.

Bending moment is positive when the impact side (+x) is in compression: the lower body has turned more than
the upper.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import ANGLE, POWER, STORED, Floats, Integers, Law, Scene
from certkit.mechanics.solver.compiling import compiled

LAW = Law(
    "joint springs",
    ("upper", "lower"),
    ("stiffness", "damping", "cable angle", "cable stiffness"),
    ("moment", "angle"),
)


@compiled
def bend(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the joint moments; see `certkit.mechanics.force_laws.law`."""
    stored = power = 0.0
    for i in range(index.shape[0]):
        upper, lower = index[i, 0], index[i, 1]
        angle = scene.pose[lower, ANGLE] - scene.pose[upper, ANGLE]
        rate = scene.rate[lower, 2] - scene.rate[upper, 2]
        excess = abs(angle) - number[i, 2]
        moment = number[i, 0] * angle
        stored += 0.5 * number[i, 0] * angle * angle
        if excess > 0.0:
            moment += number[i, 3] * excess if angle > 0.0 else -number[i, 3] * excess
            stored += 0.5 * number[i, 3] * excess * excess
        damping = number[i, 1] * rate
        power += damping * rate
        moment += damping
        load[lower, 2] -= moment
        load[upper, 2] += moment
        state[i, 0] = moment
        state[i, 1] = angle
    ledger[STORED] += stored
    ledger[POWER] += power
