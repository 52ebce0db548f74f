"""Cables on preloaded springs, ligaments and the tension of the flesh: they pull and never push."""

from __future__ import annotations

import math

from certkit.mechanics.force_laws.law import COS, POWER, SIN, STORED, Floats, Integers, Law, Scene, X, Z
from certkit.mechanics.solver.compiling import compiled

LAW = Law(
    "cables",
    ("upper", "lower"),
    ("upper x", "upper z", "lower x", "lower z", "length", "stiffness", "preload", "damping"),
    ("elongation", "tension"),
)


@compiled
def pull(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the cable tensions; see `certkit.mechanics.force_laws.law`."""
    pose, rate = scene.pose, scene.rate
    stored = power = 0.0
    for i in range(index.shape[0]):
        a, b = index[i, 0], index[i, 1]
        ax = pose[a, COS] * number[i, 0] - pose[a, SIN] * number[i, 1]
        az = pose[a, SIN] * number[i, 0] + pose[a, COS] * number[i, 1]
        bx = pose[b, COS] * number[i, 2] - pose[b, SIN] * number[i, 3]
        bz = pose[b, SIN] * number[i, 2] + pose[b, COS] * number[i, 3]
        dx = pose[a, X] + ax - pose[b, X] - bx
        dz = pose[a, Z] + az - pose[b, Z] - bz
        length = math.sqrt(dx * dx + dz * dz)
        ux, uz = dx / length, dz / length
        elongation = length - number[i, 4]
        lengthening = (rate[a, 0] - rate[a, 2] * az - rate[b, 0] + rate[b, 2] * bz) * ux + (
            rate[a, 1] + rate[a, 2] * ax - rate[b, 1] - rate[b, 2] * bx
        ) * uz
        elastic = number[i, 6] + number[i, 5] * elongation
        elastic = max(elastic, 0.0)
        tension = elastic + number[i, 7] * lengthening if elastic > 0.0 else 0.0
        tension = max(tension, 0.0)
        power += (tension - elastic) * lengthening
        if number[i, 5] > 0.0:
            stored += 0.5 * elastic * elastic / number[i, 5]
        else:
            stored += elastic * elongation
        load[a, 0] -= tension * ux
        load[a, 1] -= tension * uz
        load[a, 2] -= tension * (ax * uz - az * ux)
        load[b, 0] += tension * ux
        load[b, 1] += tension * uz
        load[b, 2] += tension * (bx * uz - bz * ux)
        state[i, 0] = elongation
        state[i, 1] = tension
    ledger[STORED] += stored
    ledger[POWER] += power
