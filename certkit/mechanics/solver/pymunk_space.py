"""A `World` as a pymunk space, and the memory through which compiled code talks to it."""

# pymunk's public API offers no addresses:
# ruff: noqa: SLF001

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pymunk
from msgspec import Struct
from pymunk import batch
from pymunk._chipmunk_cffi import ffi, lib

from certkit.errors import RunError
from certkit.mechanics.records import table_of
from certkit.mechanics.solver.kernel_arguments import PymunkAddresses

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.mechanics.records import Floats, Structured
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
    for a, b, ax, az, bx, bz in world.pivots.tolist():
        joint = pymunk.PivotJoint(every[a], every[b], (ax, az), (bx, bz))
        joint.error_bias = 1e-300  # corrected at 691/s; the default hardly corrects at these steps
        space.add(joint)
    ids = batch.Buffer()
    batch.get_space_bodies(space, batch.BodyFields.BODY_ID, ids)
    if list(memoryview(ids.int_buf()).cast("P"))[: len(bodies)] != [body.id for body in bodies]:
        raise RunError(
            "pymunk walks the bodies in an unexpected order; install the pymunk that certkit asks for"
        )
    return space


class SpaceMemory(Struct, frozen=True):
    """Addresses and memory for the compiled loop. Keeps alive what they point into.

    Parameters
    ----------
    addresses : ndarray of PymunkAddresses, shape (1,)
    read_counter, write_counter : ndarray of int32, shape (2,)
        Fill count and capacity of the reading and the writing buffer, seen in place.
    motion, load : ndarray, shape (6·rows,) and (3·rows,)
        Memory of both buffers: x, z, angle and velocities of each body; force and torque of each.
    """

    addresses: Structured
    read_counter: NDArray[np.int32]
    write_counter: NDArray[np.int32]
    motion: Floats
    load: Floats
    keep: tuple[object, ...]


def share_memory(space: pymunk.Space, world: World) -> SpaceMemory:
    """Give compiled code and a space common memory."""
    rows = len(world.names) + SPARE
    motion, load = np.zeros(6 * rows), np.zeros(3 * rows)
    buffers = batch.Buffer(), batch.Buffer()
    requests = []
    for buffer, memory, wanted in zip(buffers, (motion, load), (GET, SET), strict=True):
        buffer.set_float_buf(memory)
        request = ffi.new("pmBatchedData *")
        request.fields = wanted.value
        request.floatArray = buffer._float_arr
        request.intArray = buffer._int_arr
        requests.append(request)
    first, second = (np.frombuffer(ffi.buffer(b._float_arr, 8), dtype=np.int32) for b in buffers)

    def address(thing: object) -> int:
        return int(ffi.cast("intptr_t", thing))

    hinge = list(space.constraints)[world.hinge]._constraint if world.hinge >= 0 else ffi.NULL
    addresses = PymunkAddresses(
        step=address(ffi.addressof(lib, "cpSpaceStep")),
        each_body=address(ffi.addressof(lib, "cpSpaceEachBody")),
        read_body=address(ffi.addressof(lib, "pmSpaceBodyGetIteratorFuncBatched")),
        write_body=address(ffi.addressof(lib, "pmSpaceBodySetIteratorFuncBatched")),
        space=address(space._space),
        read_request=address(requests[0]),
        write_request=address(requests[1]),
        impulse=address(ffi.addressof(lib, "cpConstraintGetImpulse")),
        hinge=address(hinge),
    )
    kept = (space, buffers, tuple(requests))
    return SpaceMemory(table_of(PymunkAddresses, [addresses]), first, second, motion, load, kept)
