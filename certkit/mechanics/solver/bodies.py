"""What the loop does with the bodies themselves: carry them on, weigh them, measure them."""

from __future__ import annotations

import math

from certkit.mechanics.force_laws import DRAG, GRAVITY
from certkit.mechanics.force_laws.law import ANGLE, COS, POWER, SIN, STORED, Floats, Integers, Scene, X, Z
from certkit.mechanics.solver.compiling import compiled

FASTEST = 1e3  # m/s or rad/s: a body beyond it has run away


@compiled
def weigh(mass: Floats, drag: Floats, gravity: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Start each body's load with its weight and mass damping."""
    pose, rate = scene.pose, scene.rate
    for i in range(mass.shape[0]):
        m, damping = mass[i], mass[i] * drag[i]
        load[i, 0] = m * gravity[0] - damping * rate[i, 0]
        load[i, 1] = m * gravity[1] - damping * rate[i, 1]
        load[i, 2] = 0.0
        ledger[GRAVITY, STORED] -= m * (gravity[0] * pose[i, X] + gravity[1] * pose[i, Z])
        ledger[DRAG, POWER] += damping * (rate[i, 0] * rate[i, 0] + rate[i, 1] * rate[i, 1])


@compiled
def predict(buffer: Floats, share: float, step: float, pose: Floats, rate: Floats, move: Floats) -> bool:
    """Carry the bodies in pymunk's `buffer` on by `step`; False when one of them has run away."""
    sane = True
    for i in range(pose.shape[0] - 1):
        for k in range(3):
            v = buffer[6 * i + 3 + k]
            rate[i, k] = v + share * (v - move[i, k])
            move[i, k] = v
            sane = sane and abs(v) < FASTEST
        pose[i, X] = buffer[6 * i] + step * move[i, 0]
        pose[i, Z] = buffer[6 * i + 1] + step * move[i, 1]
        angle = buffer[6 * i + 2] + step * move[i, 2]
        pose[i, ANGLE] = angle
        pose[i, COS] = math.cos(angle)
        pose[i, SIN] = math.sin(angle)
    return sane


@compiled
def widest_gap(pose: Floats, pivot: Integers, anchor: Floats) -> float:
    """Return the largest distance between the two halves of a pivot."""
    widest = 0.0
    for i in range(pivot.shape[0]):
        a, b = pivot[i, 0], pivot[i, 1]
        dx = pose[a, X] + pose[a, COS] * anchor[i, 0] - pose[a, SIN] * anchor[i, 1]
        dx -= pose[b, X] + pose[b, COS] * anchor[i, 2] - pose[b, SIN] * anchor[i, 3]
        dz = pose[a, Z] + pose[a, SIN] * anchor[i, 0] + pose[a, COS] * anchor[i, 1]
        dz -= pose[b, Z] + pose[b, SIN] * anchor[i, 2] + pose[b, COS] * anchor[i, 3]
        widest = max(widest, math.sqrt(dx * dx + dz * dz))
    return widest


@compiled
def kinetic_energy(given: Floats, move: Floats, half: float, mass: Floats, inertia: Floats) -> float:
    """Return the kinetic energy between two half steps: `move` before the instant, `given` after it."""
    total = 0.0
    for i in range(mass.shape[0]):
        vx = move[i, 0] + half * (given[6 * i + 3] - move[i, 0])
        vz = move[i, 1] + half * (given[6 * i + 4] - move[i, 1])
        w = move[i, 2] + half * (given[6 * i + 5] - move[i, 2])
        total += 0.5 * (mass[i] * (vx * vx + vz * vz) + inertia[i] * w * w)
    return total
