"""Honeycomb: each strip of its face rises elastically to its crush strength and is then crushed for good.

Its force per unit height is the crush strength times the contact width of the segment it meets; the contact
pushes only.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import (
    FORCE,
    SPENT,
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
    "honeycomb",
    ("carrier",),
    ("face x", "face z", "height", "strength", "elastic depth", "thickness"),
    ("crushed", "force"),
)


@compiled
def crush(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the honeycomb's force; see `certkit.mechanics.force_laws.law`."""
    pose = scene.pose
    row = 0
    for i in range(index.shape[0]):
        carrier = index[i, 0]
        if i > 0 and carrier != index[i - 1, 0]:
            row = 0
        z = pose[carrier, Z] + number[i, 1]
        state[i, 1] = 0.0
        found = row_at(scene, z, row)
        if found < 0:
            continue
        row = found
        x, by_z, by_angle = face_at(scene, row, z, number[i, 5])
        yield_depth = number[i, 4]
        elastic = x - pose[carrier, X] - number[i, 0] - state[i, 0]
        if elastic <= 0.0:
            continue
        strength = number[i, 3] * scene.outline[row, 3] * number[i, 2]
        if elastic > yield_depth:
            ledger[SPENT] += strength * (elastic - yield_depth)
            state[i, 0] += elastic - yield_depth
            elastic = yield_depth
        force = strength * elastic / yield_depth
        ledger[STORED] += 0.5 * force * elastic
        ledger[FORCE] += force
        body = scene.outline_body[row]
        load[body, 0] -= force
        load[body, 1] -= force * by_z
        load[body, 2] -= force * by_angle
        load[carrier, 0] += force
        load[carrier, 1] += force * by_z
        state[i, 1] = force
