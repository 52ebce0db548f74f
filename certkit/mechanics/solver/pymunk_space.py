"""A `World` as a pymunk space, and the memory through which compiled code talks to it."""

# pymunk's public API offers no addresses:
# ruff: noqa: SLF001

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pymunk
from pymunk import batch
from pymunk._chipmunk_cffi import ffi, lib

from certkit.errors import RunError

if TYPE_CHECKING:
    from certkit.mechanics.force_laws.law import Floats, Heads, Integers
    from certkit.mechanics.solver.world import World

ITERATIONS = 8
SPARE = 8  # rows: Munk2D reallocates (and so corrupts) a buffer that is within two slots of full

GET = (
    batch.BodyFields.POSITION
    | batch.BodyFields.ANGLE
    | batch.BodyFields.VELOCITY
    | batch.BodyFields.ANGULAR_VELOCITY
)
SET = batch.BodyFields.FORCE | batch.BodyFields.TORQUE


def build_space(world: World, step: float, iterations: int = ITERATIONS) -> pymunk.Space:
    """Make the space: bodies in the world's order, half a step before time zero, then pivots.

    Raises
    ------
    RunError
        When pymunk does not walk the bodies in that order.
    """
    space = pymunk.Space()
    space.iterations = iterations
    bodies = []
    for i in range(len(world.names)):
        point = world.inertia[i] == 0.0 or world.guided[i] > 0.0
        body = pymunk.Body(float(world.mass[i]), float("inf") if point else float(world.inertia[i]))
        x, z, angle = (float(q) for q in world.pose[i] - 0.5 * step * world.speed[i])
        body.position = x, z
        body.angle = angle
        vx, vz, rate = (float(v) for v in world.speed[i])
        body.velocity = vx, vz
        body.angular_velocity = rate
        bodies.append(body)
    space.add(*bodies)
    every = [*bodies, space.static_body]
    for (a, b), (ax, az, bx, bz) in zip(world.pivot.tolist(), world.anchor.tolist(), strict=True):
        joint = pymunk.PivotJoint(every[a], every[b], (ax, az), (bx, bz))
        joint.error_bias = 1e-300  # corrected at 691/s; the default hardly corrects at these steps
        space.add(joint)
    ids = batch.Buffer()
    batch.get_space_bodies(space, batch.BodyFields.BODY_ID, ids)
    if list(memoryview(ids.int_buf()).cast("P"))[: len(bodies)] != [body.id for body in bodies]:
        raise RunError(
            "pymunk walks the bodies in an unexpected order; use a pymunk version the project card allows"
        )
    return space


@dataclass(frozen=True)
class Gateway:
    """Addresses and memory for the compiled loop. Keeps alive what they point into.

    Parameters
    ----------
    entry : ndarray of int64, shape (9,)
        See `certkit.mechanics.solver.kernel_arguments.Handover`.
    counters : two ndarrays of int32, shape (2,)
        Heads (fill count, capacity) of the get and the set buffer, seen in place.
    given, taken : ndarray
        Memory of both.
    """

    entry: Integers
    counters: Heads
    given: Floats
    taken: Floats
    keep: tuple[object, ...]


def open_gateway(space: pymunk.Space, world: World) -> Gateway:
    """Open the way between compiled code and a space."""
    rows = len(world.names) + SPARE
    given, taken = np.zeros(6 * rows), np.zeros(3 * rows)
    buffers = batch.Buffer(), batch.Buffer()
    data = []
    for buffer, memory, fields in zip(buffers, (given, taken), (GET, SET), strict=True):
        buffer.set_float_buf(memory)
        request = ffi.new("pmBatchedData *")
        request.fields = fields.value
        request.floatArray = buffer._float_arr
        request.intArray = buffer._int_arr
        data.append(request)
    first, second = (np.frombuffer(ffi.buffer(b._float_arr, 8), dtype=np.int32) for b in buffers)

    def address(thing: object) -> int:
        return int(ffi.cast("intptr_t", thing))

    hinge = list(space.constraints)[world.hinge]._constraint if world.hinge >= 0 else ffi.NULL
    entry = np.array(
        [
            address(ffi.addressof(lib, "cpSpaceStep")),
            address(ffi.addressof(lib, "cpSpaceEachBody")),
            address(ffi.addressof(lib, "pmSpaceBodyGetIteratorFuncBatched")),
            address(ffi.addressof(lib, "pmSpaceBodySetIteratorFuncBatched")),
            address(space._space),
            address(data[0]),
            address(data[1]),
            address(ffi.addressof(lib, "cpConstraintGetImpulse")),
            address(hinge),
        ],
        dtype=np.int64,
    )
    return Gateway(entry, (first, second), given, taken, (space, buffers, tuple(data)))
