"""Flesh hung on its bone segment by a spring and damper across the bone and one along it.

The force acts where the flesh is, on both bodies, so that linear and angular momentum are kept exactly.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import COS, POWER, SIN, STORED, Floats, Integers, Law, Scene, X, Z
from certkit.mechanics.solver.compiling import compiled

LAW = Law(
    "flesh",
    ("bone", "flesh"),
    ("height", "stiffness across", "stiffness along", "damping across", "damping along"),
    ("shift across", "shift along"),
)


@compiled
def hang(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the springs between flesh and bone; see `certkit.mechanics.force_laws.law`."""
    pose, rate = scene.pose, scene.rate
    stored = power = 0.0
    for i in range(index.shape[0]):
        bone, flesh = index[i, 0], index[i, 1]
        c, s = pose[bone, COS], pose[bone, SIN]
        dx = pose[flesh, X] - pose[bone, X]
        dz = pose[flesh, Z] - pose[bone, Z]
        rx, rz = c * dx + s * dz, c * dz - s * dx
        vx = rate[flesh, 0] - rate[bone, 0]
        vz = rate[flesh, 1] - rate[bone, 1]
        turn = rate[bone, 2]
        across, along = rx, rz - number[i, 0]
        across_rate = c * vx + s * vz + turn * rz
        along_rate = c * vz - s * vx - turn * rx
        damping_across = number[i, 3] * across_rate
        damping_along = number[i, 4] * along_rate
        # Force on the bone in its own frame.
        fx = number[i, 1] * across + damping_across
        fz = number[i, 2] * along + damping_along
        stored += 0.5 * (number[i, 1] * across * across + number[i, 2] * along * along)
        power += damping_across * across_rate + damping_along * along_rate
        gx, gz = c * fx - s * fz, s * fx + c * fz
        load[bone, 0] += gx
        load[bone, 1] += gz
        load[bone, 2] += rx * fz - rz * fx
        load[flesh, 0] -= gx
        load[flesh, 1] -= gz
        state[i, 0] = across
        state[i, 1] = along
    ledger[STORED] += stored
    ledger[POWER] += power
