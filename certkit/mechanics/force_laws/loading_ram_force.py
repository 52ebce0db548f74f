"""The loading ram's force, from a schedule of levels: on a body, or straight on the specimen at a station.

Between two segments the force is shared by both.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import (
    COS,
    POWER,
    SIN,
    Floats,
    Integers,
    Law,
    Scene,
    X,
    Z,
)
from certkit.mechanics.force_laws.leg_outline import row_at
from certkit.mechanics.solver.compiling import compiled

LAW = Law("loading ram", ("ram",), ("station", "start"), ("force", "travel"))

JOINT = 1e-9  # m: how near a joint the station counts as on it


@compiled
def _scheduled(schedule: Floats, time: float) -> float:
    last = schedule.shape[0] - 1
    if time >= schedule[last, 0]:
        return float(schedule[last, 1])
    k = 0
    while time >= schedule[k + 1, 0]:
        k += 1
    share = (time - schedule[k, 0]) / (schedule[k + 1, 0] - schedule[k, 0])
    return float(schedule[k, 1] + share * (schedule[k + 1, 1] - schedule[k, 1]))


@compiled
def push(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the ram's force, along -x; its work is booked as negative dissipation."""
    pose, rate = scene.pose, scene.rate
    for i in range(index.shape[0]):
        force = _scheduled(scene.schedule, scene.time)
        state[i, 0] = force
        ram = index[i, 0]
        if ram < pose.shape[0] - 1:
            load[ram, 0] -= force
            ledger[POWER] += force * rate[ram, 0]
            state[i, 1] = number[i, 1] - pose[ram, X]
            continue
        state[i, 1] = number[i, 1]
        for side in range(2):
            z = number[i, 0] + (JOINT if side == 0 else -JOINT)
            row = row_at(scene, z, 0)
            if row < 0:
                continue
            body = scene.outline_body[row]
            lever = number[i, 0] - pose[body, Z]
            load[body, 0] -= 0.5 * force
            load[body, 2] += 0.5 * force * lever
            ledger[POWER] += 0.5 * force * (rate[body, 0] - rate[body, 2] * lever)
            state[i, 1] -= 0.5 * (pose[body, X] - lever * pose[body, SIN] / pose[body, COS])
