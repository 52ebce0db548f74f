"""The round nose of the loading ram on the flat face of a knee block.

It pushes along x; what its normal would add along the leg is carried by friction on the neoprene sheet and
booked as dissipated.
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
from certkit.mechanics.solver.compiling import compiled

LAW = Law(
    "ram nose",
    ("ram", "block"),
    ("radius", "face", "stiffness", "damping"),
    ("depth", "force"),
)


@compiled
def lean(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the contact of nose and blocks; see `certkit.mechanics.force_laws.law`."""
    pose, rate = scene.pose, scene.rate
    for i in range(index.shape[0]):
        ram, block = index[i, 0], index[i, 1]
        c, s = pose[block, COS], pose[block, SIN]
        dx = pose[ram, X] - pose[block, X]
        dz = pose[ram, Z] - pose[block, Z]
        depth = number[i, 0] + number[i, 1] - (c * dx + s * dz)
        state[i, 0] = depth
        state[i, 1] = 0.0
        if depth <= 0.0:
            continue
        vx = rate[ram, 0] - rate[block, 0]
        vz = rate[ram, 1] - rate[block, 1]
        closing = -(c * vx + s * vz + rate[block, 2] * (c * dz - s * dx))
        elastic = number[i, 2] * depth
        force = max(elastic + number[i, 3] * closing, 0.0)
        # Height of the contact above the block's centre of gravity.
        lever = dz - number[i, 0] * s
        load[block, 0] -= force
        load[block, 2] += force * lever
        load[ram, 0] += force
        given = force * (rate[ram, 0] - rate[block, 0] + rate[block, 2] * lever)
        ledger[STORED] += 0.5 * elastic * depth
        ledger[POWER] += -given - elastic * closing
        ledger[DEPTH] = max(ledger[DEPTH], depth)
        state[i, 1] = force
