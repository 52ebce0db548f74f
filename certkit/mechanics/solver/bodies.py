"""The bodies in a time step: prediction, weight and mass damping, kinetic energy, gaps of the pivots."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws import MASS_DAMPING_ACCOUNT, WEIGHT_ACCOUNT

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import Instant, Load, Pose, Totals, Velocity
    from certkit.mechanics.records import Floats, Rows
    from certkit.mechanics.solver.kernel_arguments import BodyMotion
    from certkit.mechanics.solver.world import Pivot

FASTEST = 1e3
"""m/s or rad/s: a body beyond it has run away."""


@compiled
def add_weight_and_damping(
    mass: Floats, damping: Floats, gravity: Floats, now: Instant, load: Rows[Load], totals: Rows[Totals]
) -> None:
    """Start each body's load with its weight m·g and its mass damping −m·α·v, N.

    `mass` m (kg) and `damping` α (1/s) have the shape (bodies,), `gravity` g (m/s²) the shape (2,).
    """
    for i in range(mass.shape[0]):
        m, rate = mass[i], mass[i] * damping[i]
        pose, velocity, on_body = now.pose[i], now.velocity[i], load[i]
        on_body.x = m * gravity[0] - rate * velocity.x
        on_body.z = m * gravity[1] - rate * velocity.z
        on_body.torque = 0.0
        totals[WEIGHT_ACCOUNT].stored -= m * (gravity[0] * pose.x + gravity[1] * pose.z)
        totals[MASS_DAMPING_ACCOUNT].power += rate * (velocity.x * velocity.x + velocity.z * velocity.z)


@compiled
def predict(
    motion: Rows[BodyMotion],
    share: float,
    step: float,
    pose: Rows[Pose],
    velocity: Rows[Velocity],
    step_velocity: Rows[Velocity],
) -> bool:
    """Predict where the bodies are when the forces act; False when one of them has run away.

    `cpSpaceStep` moves the bodies with the velocities they have and then changes the velocities by the
    forces it was given. Forces from the positions just read would therefore be explicit Euler, which gains
    energy without end. So they are evaluated at

    - x + v·dt, the position at the end of the move that the same call makes: with velocities half a step
      later this is the leapfrog scheme, second order and energy-keeping (Hairer, Lubich and Wanner,
      Geometric Numerical Integration, 2006, section I.1.4);
    - v* = v + s·(v - v_before), the velocity at that instant, for damping: v stands at the middle of the
      step before, so s = ½ extrapolates it by half a step (s = 1 after the first step, which is half as
      long; 0 in it).

    Parameters
    ----------
    motion : shape (≥ bodies,)
        As read from pymunk: positions, and v, half a step older than the forces to come.
    share : float
        s.
    step : float
        dt, s.
    pose, velocity, step_velocity : shape (bodies + 1,)
        Filled, except for the ground in the last row: the prediction, v* and v. `step_velocity` brings
        v_before.
    """
    sane = True
    for i in range(len(pose) - 1):
        read, at, damped, moved = motion[i], pose[i], velocity[i], step_velocity[i]
        v = read.velocity_x
        damped.x = v + share * (v - moved.x)
        moved.x = v
        sane = sane and abs(v) < FASTEST
        v = read.velocity_z
        damped.z = v + share * (v - moved.z)
        moved.z = v
        sane = sane and abs(v) < FASTEST
        v = read.angular_velocity
        damped.angular = v + share * (v - moved.angular)
        moved.angular = v
        sane = sane and abs(v) < FASTEST
        at.x = read.x + step * moved.x
        at.z = read.z + step * moved.z
        angle = read.angle + step * moved.angular
        at.angle = angle
        at.cos = math.cos(angle)
        at.sin = math.sin(angle)
    return sane


@compiled
def widest_gap(pose: Rows[Pose], pivots: Rows[Pivot]) -> float:
    """Return the largest distance between the two halves of a pivot, m."""
    widest = 0.0
    for i in range(len(pivots)):
        pivot = pivots[i]
        a, b = pose[pivot.first], pose[pivot.second]
        dx = a.x + a.cos * pivot.first_x - a.sin * pivot.first_z
        dx -= b.x + b.cos * pivot.second_x - b.sin * pivot.second_z
        dz = a.z + a.sin * pivot.first_x + a.cos * pivot.first_z
        dz -= b.z + b.sin * pivot.second_x + b.cos * pivot.second_z
        widest = max(widest, math.sqrt(dx * dx + dz * dz))
    return widest


@compiled
def kinetic_energy(
    motion: Rows[BodyMotion], before: Rows[Velocity], share: float, mass: Floats, inertia: Floats
) -> float:
    """Return Σ ½·m·v² + ½·J·ω² at an instant between two half steps, J.

    v = v_before + share·(v_after - v_before), with `before` half a step earlier and `motion` half a step
    later. `mass` (kg) and `inertia` (kg·m²) have the shape (bodies,).
    """
    total = 0.0
    for i in range(mass.shape[0]):
        after, earlier = motion[i], before[i]
        vx = earlier.x + share * (after.velocity_x - earlier.x)
        vz = earlier.z + share * (after.velocity_z - earlier.z)
        w = earlier.angular + share * (after.angular_velocity - earlier.angular)
        total += 0.5 * (mass[i] * (vx * vx + vz * vz) + inertia[i] * w * w)
    return total
