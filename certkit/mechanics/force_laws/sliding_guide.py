"""A guide between the knee blocks: they slide freely against each other for a way, then a spring holds them.

The slide is measured across the lower block, at one point of each block; force k·(|s| − s₀) beyond the free
travel s₀, with a damper while it bears. Both blocks meet it on one line, so that momentum is kept.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import COS, POWER, SIN, STORED, Floats, Integers, Law, Scene, X, Z
from certkit.mechanics.solver.compiling import compiled

LAW = Law(
    "knee guide",
    ("upper", "lower"),
    ("upper x", "upper z", "lower x", "free travel", "stiffness", "damping"),
    ("slide", "force"),
)


@compiled
def guide(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the guide's force; see `certkit.mechanics.force_laws.law`."""
    pose, rate = scene.pose, scene.rate
    for i in range(index.shape[0]):
        a, b = index[i, 0], index[i, 1]
        c, s = pose[b, COS], pose[b, SIN]
        # The upper block's point, from each centre of gravity.
        ax = pose[a, COS] * number[i, 0] - pose[a, SIN] * number[i, 1]
        az = pose[a, SIN] * number[i, 0] + pose[a, COS] * number[i, 1]
        bx = pose[a, X] + ax - pose[b, X]
        bz = pose[a, Z] + az - pose[b, Z]
        slide = c * bx + s * bz - number[i, 2]
        state[i, 0] = slide
        state[i, 1] = 0.0
        excess = abs(slide) - number[i, 3]
        if excess <= 0.0:
            continue
        vx = rate[a, 0] - rate[a, 2] * az - rate[b, 0] + rate[b, 2] * bz
        vz = rate[a, 1] + rate[a, 2] * ax - rate[b, 1] - rate[b, 2] * bx
        opening = c * vx + s * vz
        way = 1.0 if slide > 0.0 else -1.0
        elastic = number[i, 4] * excess
        bearing = max(elastic + number[i, 5] * way * opening, 0.0)
        fx, fz = -way * bearing * c, -way * bearing * s
        load[a, 0] += fx
        load[a, 1] += fz
        load[a, 2] += ax * fz - az * fx
        load[b, 0] -= fx
        load[b, 1] -= fz
        load[b, 2] -= bx * fz - bz * fx
        ledger[STORED] += 0.5 * elastic * excess
        ledger[POWER] += (bearing - elastic) * way * opening
        state[i, 1] = way * bearing
