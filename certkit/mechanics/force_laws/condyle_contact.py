"""A round condyle in a round trough: penalty contact with Coulomb friction.

Friction is a tangential spring that slips when it carries more than friction allows (Cundall and Strack,
Géotechnique 29, 1979). Unlike friction smoothed over the sliding speed it holds a load at rest, which the
static tests need.
"""

from __future__ import annotations

import math

from certkit.mechanics.force_laws.law import (
    COS,
    DEPTH,
    POWER,
    SIN,
    SPENT,
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
    "condyles",
    ("upper", "lower"),
    (
        "condyle x",
        "condyle z",
        "trough x",
        "trough z",
        "clearance",
        "radius",
        "stiffness",
        "damping",
        "friction",
        "tangential stiffness",
    ),
    ("slip spring", "normal force", "depth"),
)


@compiled
def press(index: Integers, number: Floats, state: Floats, scene: Scene, load: Floats, ledger: Floats) -> None:
    """Add contact and friction of the condyles; see `certkit.mechanics.force_laws.law`."""
    pose, rate, move = scene.pose, scene.rate, scene.move
    for i in range(index.shape[0]):
        a, b = index[i, 0], index[i, 1]
        # Middle of the condyle and of the trough, from each body's centre of gravity.
        ax = pose[a, COS] * number[i, 0] - pose[a, SIN] * number[i, 1]
        az = pose[a, SIN] * number[i, 0] + pose[a, COS] * number[i, 1]
        bx = pose[b, COS] * number[i, 2] - pose[b, SIN] * number[i, 3]
        bz = pose[b, SIN] * number[i, 2] + pose[b, COS] * number[i, 3]
        dx = pose[a, X] + ax - pose[b, X] - bx
        dz = pose[a, Z] + az - pose[b, Z] - bz
        distance = math.sqrt(dx * dx + dz * dz)
        depth = distance - number[i, 4]
        state[i, 2] = depth
        state[i, 1] = 0.0
        if depth <= 0.0:
            state[i, 0] = 0.0
            continue
        nx, nz = dx / distance, dz / distance
        # The point of contact, from each centre of gravity.
        pax, paz = ax + number[i, 5] * nx, az + number[i, 5] * nz
        pbx = pose[a, X] + pax - pose[b, X]
        pbz = pose[a, Z] + paz - pose[b, Z]
        vx = rate[a, 0] - rate[a, 2] * paz - rate[b, 0] + rate[b, 2] * pbz
        vz = rate[a, 1] + rate[a, 2] * pax - rate[b, 1] - rate[b, 2] * pbx
        closing = vx * nx + vz * nz
        elastic = number[i, 6] * depth
        normal = elastic + number[i, 7] * closing
        normal = max(normal, 0.0)
        tx, tz = -nz, nx
        mx = move[a, 0] - move[a, 2] * paz - move[b, 0] + move[b, 2] * pbz
        mz = move[a, 1] + move[a, 2] * pax - move[b, 1] - move[b, 2] * pbx
        spring = state[i, 0] + (mx * tx + mz * tz) * scene.step
        stiffness = number[i, 9]
        limit = number[i, 8] * normal / stiffness
        held = min(max(spring, -limit), limit)
        # Slip, under the mean of the forces before and after: exact both for steady sliding and where a
        # falling normal force makes a resting contact creep.
        ledger[SPENT] += 0.5 * stiffness * (state[i, 0] + held) * (spring - held)
        friction = stiffness * held
        fx = -normal * nx - friction * tx
        fz = -normal * nz - friction * tz
        load[a, 0] += fx
        load[a, 1] += fz
        load[a, 2] += pax * fz - paz * fx
        load[b, 0] -= fx
        load[b, 1] -= fz
        load[b, 2] -= pbx * fz - pbz * fx
        ledger[STORED] += 0.5 * elastic * depth + 0.5 * friction * held
        ledger[POWER] += (normal - elastic) * closing
        ledger[DEPTH] = max(ledger[DEPTH], depth)
        state[i, 0] = held
        state[i, 1] = normal
