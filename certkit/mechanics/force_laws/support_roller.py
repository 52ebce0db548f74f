"""Rollers that stay where they are in space while the bone slides over them.

The reaction is along the load (x) at a fixed station, so the moment at mid-span is F/2 · span/2 whatever
the deflection: what a frictionless roller would add along the bone is carried by friction there. The work
of that friction is booked as dissipated.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import (
    COS,
    DEPTH,
    POWER,
    SIN,
    STORED,
    Floats,
    Integers,
    Law,
    Scene,
    X,
    Z,
)
from certkit.mechanics.force_laws.leg_outline import row_at
from certkit.mechanics.solver.compiling import compiled

LAW = Law("supports", ("carrier",), ("station", "stiffness", "damping"), ("depth", "force"))


@compiled
def carry(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the reactions of the rollers, which stand at x = 0 and push along +x."""
    pose, rate = scene.pose, scene.rate
    for i in range(index.shape[0]):
        z = number[i, 0]
        state[i, 0] = state[i, 1] = 0.0
        row = row_at(scene, z, 0)
        if row < 0:
            continue
        body = scene.outline_body[row]
        tangent = pose[body, SIN] / pose[body, COS]
        lever = z - pose[body, Z]
        depth = lever * tangent - pose[body, X]
        if depth <= 0.0:
            continue
        point_speed = rate[body, 0] - rate[body, 2] * lever
        face_speed = (
            rate[body, 0] + tangent * rate[body, 1] - rate[body, 2] * lever * (1.0 + tangent * tangent)
        )
        elastic = number[i, 1] * depth
        force = max(elastic - number[i, 2] * face_speed, 0.0)
        load[body, 0] += force
        load[body, 2] -= force * lever
        ledger[STORED] += 0.5 * elastic * depth
        ledger[POWER] += force * (face_speed - point_speed) - (force - elastic) * face_speed
        ledger[DEPTH] = max(ledger[DEPTH], depth)
        state[i, 0] = depth
        state[i, 1] = force
