"""The leg's flesh against the faces of a car front: sliding contact, pushing only, with friction.

The front is cut into strips of constant height above the ground. A strip's face moves with the group it
belongs to or, between two neighbouring groups, with a mean of both: the face stays one line without steps,
and a force on it goes to both groups in the same shares, so no work is lost. The leg's face likewise goes
over from one segment to the next within a short ramp, and fades out at the leg's ends: where it jumped,
strips that the leg slides along would gain depth without work. Force per unit height p = k·d·(1 + (d/d₀)²)
with depth d, as in `certkit.mechanics.force_laws.flesh_compression`.
"""

from __future__ import annotations

import math

from certkit.mechanics.force_laws.law import (
    COS,
    FORCE,
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
from certkit.mechanics.force_laws.leg_outline import STEEPEST, face_at
from certkit.mechanics.solver.compiling import compiled

LAW = Law(
    "front contact",
    ("lower", "upper"),
    ("face x", "face z", "share", "height", "compression", "stiffening depth", "thickness", "friction"),
    ("depth", "force"),
)

RAMP = 0.01
"""m: within this distance from a segment's end its face goes over into the next one's."""

FADE = 0.2
"""Cosine: over this range above the steepest lean that can be met, contact fades out."""

STICK = 0.1
"""m/s: sliding speed at which friction has come to three quarters of its full value."""


@compiled
def _end(scene: Scene, row: int, top: bool) -> float:  # noqa: FBT001  # compiled code takes no keywords
    """Return the height of a segment's upper or lower end."""
    body = scene.outline_body[row]
    return float(scene.pose[body, Z] + scene.outline[row, 0 if top else 1] * scene.pose[body, COS])


@compiled
def _row_at(scene: Scene, z: float, row: int) -> int:
    """Return the first row at or below `row` that stands at height `z`; -1 where there is none.

    Unlike the other obstacles' search this one passes by segments that lean too far, for those below them.
    """
    last = scene.outline_body.shape[0] - 1
    while row <= last and z < _end(scene, row, False):
        row += 1
    if row > last or (row == 0 and z > _end(scene, 0, True)):
        return -1
    return row


@compiled
def _upright(cosine: float) -> tuple[float, float]:
    """Return how much of the contact a leaning segment keeps, and how that grows with its lean's cosine."""
    kept = (cosine - STEEPEST) / FADE
    if kept >= 1.0:
        return 1.0, 0.0
    return max(kept, 0.0), (1.0 / FADE if kept > 0.0 else 0.0)


@compiled
def _pair(scene: Scene, row: int, z: float) -> tuple[int, int, float]:
    """Return the two rows that share the face at height `z`, upper first, and the lower one's weight."""
    last = scene.outline_body.shape[0] - 1
    if row < last:
        above = z - _end(scene, row, False)
        if above < RAMP:
            return row, row + 1, 0.5 * (1.0 - above / RAMP)
    if row > 0:
        above = z - _end(scene, row - 1, False)
        if above > -RAMP:
            return row - 1, row, 0.5 * (1.0 - above / RAMP)
    return row, row, 0.0


@compiled
def _part(scene: Scene, row: int, z: float) -> tuple[float, float]:
    """Return how much of the contact the leg's ends leave at `z`, and how that grows with their height."""
    last = scene.outline_body.shape[0] - 1
    if row == 0:
        left = 0.5 * (_end(scene, 0, True) - z) / RAMP
        if left < 1.0:
            return max(left, 0.0), 0.5 / RAMP
    if row == last:
        left = 0.5 * (z - _end(scene, last, False)) / RAMP
        if left < 1.0:
            return max(left, 0.0), -0.5 / RAMP
    return 1.0, 0.0


@compiled
def _press(load: Floats, body: int, force: float, by_z: float, by_angle: float) -> None:
    load[body, 0] -= force
    load[body, 1] -= force * by_z
    load[body, 2] -= force * by_angle


@compiled
def slide(  # noqa: PLR0915  # one contact, force by force
    index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats
) -> None:
    """Add the contact of leg and front; see `certkit.mechanics.force_laws.law`."""
    pose, rate = scene.pose, scene.rate
    row = 0
    for i in range(index.shape[0]):
        first, second = index[i, 0], index[i, 1]
        share = number[i, 2]
        face = number[i, 0] + (1.0 - share) * pose[first, X] + share * pose[second, X]
        z = number[i, 1]
        state[i, 0] = state[i, 1] = 0.0
        found = _row_at(scene, z, row)
        if found < 0:
            continue
        row = found
        upper, lower, weight = _pair(scene, row, z)
        above, below = scene.outline_body[upper], scene.outline_body[lower]
        kept, gain = _upright(pose[above, COS])
        kept_below, gain_below = _upright(pose[below, COS])
        lean = (1.0 - weight) * kept + weight * kept_below
        if lean <= 0.0:
            continue
        x, by_z, by_angle = face_at(scene, upper, z, number[i, 6])
        across = other_z = other_angle = 0.0
        if weight > 0.0:
            other, other_z, other_angle = face_at(scene, lower, z, number[i, 6])
            across = other - x
            x += weight * across
        depth = x - face
        part, growth = _part(scene, row, z)
        if depth <= 0.0 or part <= 0.0:
            continue
        ratio = depth / number[i, 5]
        full = number[i, 4] * number[i, 3]
        force = part * lean * full * depth * (1.0 + ratio * ratio)
        energy = full * depth * depth * (0.5 + 0.25 * ratio * ratio)
        ledger[STORED] += part * lean * energy
        ledger[FORCE] += force
        body = scene.outline_body[row]
        _press(load, above, (1.0 - weight) * force, by_z, by_angle)
        _press(load, below, weight * force, other_z, other_angle)
        # The ramp moves with the lower end of the upper segment, and what the ends leave with the ends.
        up = (force * across + part * energy * (kept_below - kept)) * 0.5 / RAMP
        load[above, 1] -= up
        load[above, 2] += up * scene.outline[upper, 1] * pose[above, SIN]
        load[above, 2] += part * energy * (1.0 - weight) * gain * pose[above, SIN]
        load[below, 2] += part * energy * weight * gain_below * pose[below, SIN]
        end = scene.outline[row, 0 if growth > 0.0 else 1]
        load[body, 1] -= lean * energy * growth
        load[body, 2] += lean * energy * growth * end * pose[body, SIN]
        arm = x - pose[body, X]
        slip = rate[body, 1] + rate[body, 2] * arm
        rub = number[i, 7] * force * math.tanh(slip / STICK)
        load[body, 1] -= rub
        load[body, 2] -= rub * arm
        ledger[POWER] += rub * slip
        load[first, 0] += (1.0 - share) * force
        load[second, 0] += share * force
        state[i, 0] = depth
        state[i, 1] = force
