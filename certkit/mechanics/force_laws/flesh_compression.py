"""Flesh (or a cover) that is squeezed between the leg and a face: progressive, pushing only.

Force per unit height p = k·d·(1 + (d/d₀)²) with depth d.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import (
    FORCE,
    STORED,
    Floats,
    Integers,
    Law,
    Scene,
    X,
    Z,
)
from certkit.mechanics.force_laws.leg_outline import face_at, row_at
from certkit.mechanics.solver.compiling import compiled

LAW = Law(
    "flesh compression",
    ("carrier",),
    ("face x", "face z", "height", "compression", "stiffening depth", "thickness"),
    ("depth", "force"),
)


@compiled
def squeeze(
    index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats
) -> None:
    """Add the compression of the flesh; see `certkit.mechanics.force_laws.law`."""
    pose = scene.pose
    row = 0
    for i in range(index.shape[0]):
        carrier = index[i, 0]
        if i > 0 and carrier != index[i - 1, 0]:
            row = 0
        z = pose[carrier, Z] + number[i, 1]
        state[i, 0] = state[i, 1] = 0.0
        found = row_at(scene, z, row)
        if found < 0:
            continue
        row = found
        x, by_z, by_angle = face_at(scene, row, z, number[i, 5])
        depth = x - pose[carrier, X] - number[i, 0]
        if depth <= 0.0:
            continue
        ratio = depth / number[i, 4]
        stiffness = number[i, 3] * number[i, 2]
        force = stiffness * depth * (1.0 + ratio * ratio)
        ledger[STORED] += stiffness * depth * depth * (0.5 + 0.25 * ratio * ratio)
        ledger[FORCE] += force
        body = scene.outline_body[row]
        load[body, 0] -= force
        load[body, 1] -= force * by_z
        load[body, 2] -= force * by_angle
        load[carrier, 0] += force
        load[carrier, 1] += force * by_z
        state[i, 0] = depth
        state[i, 1] = force
