"""The leg's flesh against the faces of a car front: sliding contact, pushing only, with friction.

The front is cut into strips of constant height above the ground. A strip's face moves with the group it belongs to, or, between
two neighbouring groups, with a mean of both: the face stays one line without steps, and a force on it goes to both
groups in the same shares, so no work is lost. Force per unit height p = k·d·(1 + (d/d₀)²) with depth d, as in
`certkit.mechanics.laws.cushion`.
"""

from __future__ import annotations

import math

from certkit.mechanics.laws.compiling import compiled
from certkit.mechanics.laws.outline import face_at, row_at
from certkit.mechanics.laws.table import COS, FORCE, POWER, SIN, STORED, Floats, Integers, Law, Scene, X, Z

LAW = Law(
    "front contact",
    ("lower", "upper"),
    ("face x", "face z", "share", "height", "compression", "stiffening depth", "thickness", "friction"),
    ("depth", "force"),
)

RAMP = 0.01
"""m: half the length over which the leg's face goes over from one segment's depth to the next. A sharp step that slides over
the strips would change their depth without work."""

STICK = 0.1
"""m/s: sliding speed at which friction has come to three quarters of its full value."""


@compiled
def _blend(scene: Scene, row: int, height: float) -> tuple[float, float]:
    """Return what a neighbouring segment's depth adds to the face at `height` in the segment's frame, and its slope."""
    outline = scene.outline
    added = slope = 0.0
    from_top = outline[row, 0] - height
    if row > 0 and from_top < RAMP:
        slope = 0.25 * (outline[row - 1, 2] - outline[row, 2]) / (0.5 * RAMP)
        added = slope * (RAMP - from_top)
    from_bottom = height - outline[row, 1]
    if row < scene.outline_body.shape[0] - 1 and from_bottom < RAMP:
        slope = -0.25 * (outline[row + 1, 2] - outline[row, 2]) / (0.5 * RAMP)
        added = -slope * (RAMP - from_bottom)
    return added, slope


@compiled
def slide(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add the contact of leg and front; see `certkit.mechanics.laws.table`."""
    pose, rate = scene.pose, scene.rate
    row = 0
    for i in range(index.shape[0]):
        lower, upper = index[i, 0], index[i, 1]
        share = number[i, 2]
        face = number[i, 0] + (1.0 - share) * pose[lower, X] + share * pose[upper, X]
        z = number[i, 1]
        state[i, 0] = state[i, 1] = 0.0
        found = row_at(scene, z, row)
        if found < 0:
            continue
        row = found
        x, by_z, by_angle = face_at(scene, row, z, number[i, 6])
        body = scene.outline_body[row]
        c = pose[body, COS]
        tangent = pose[body, SIN] / c
        lever = z - pose[body, Z]
        added, slope = _blend(scene, row, lever / c)
        x += added / c
        by_z -= slope / (c * c)
        by_angle += (added + slope * lever / c) * tangent / c
        depth = x - face
        if depth <= 0.0:
            continue
        ratio = depth / number[i, 5]
        stiffness = number[i, 4] * number[i, 3]
        force = stiffness * depth * (1.0 + ratio * ratio)
        ledger[STORED] += stiffness * depth * depth * (0.5 + 0.25 * ratio * ratio)
        ledger[FORCE] += force
        arm = x - pose[body, X]
        slip = rate[body, 1] + rate[body, 2] * arm
        rub = number[i, 7] * force * math.tanh(slip / STICK)
        load[body, 0] -= force
        load[body, 1] -= force * by_z + rub
        load[body, 2] -= force * by_angle + rub * arm
        ledger[POWER] += rub * slip
        load[lower, 0] += (1.0 - share) * force
        load[upper, 0] += share * force
        state[i, 0] = depth
        state[i, 1] = force
