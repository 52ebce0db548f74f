"""The contact of a leg and a front that are led: what a contact law makes of a motion recorded elsewhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.mechanics.force_laws.recorded_motion import RecordedMotion
from certkit.mechanics.outputs.front_response import contact_by_group
from certkit.mechanics.rig.recorded_tables import add_tables
from certkit.mechanics.simulate import build
from certkit.mechanics.solver.time_loop import Plan, run_world

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure
    from certkit.definitions.vehicle import Vehicle
    from certkit.mechanics.records import Floats
    from certkit.mechanics.rig.rig_assembly import RigAssembly

STEP = 2e-5
"""s: as a vehicle run has it."""

SAMPLE, FRAME = 5, 500

WITHIN = 1e-4
"""m: a point so near to a segment's end is still on it."""


class LedMotion(Struct, frozen=True):
    """How leg and front move.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Seconds from the record's start, rising.
    contact : float
        When the leg stands where it first touches the front, s.
    axis : ndarray, shape (nodes, n, 2)
        x and height above the ground of points on the leg's axis, from the lowest, m.
    groups : mapping of str to ndarray, shape (n,)
        Displacement of each group of the front along x, m.
    """

    time: Floats
    contact: float
    axis: Floats
    groups: Mapping[str, Floats]


def drive_contact(
    procedure: Procedure, legform: Legform, vehicle: Vehicle, led: LedMotion
) -> tuple[Floats, dict[str, Floats]]:
    """Lead a leg and a front along their recorded motion; return the contact's time and force by group.

    Parameters
    ----------
    procedure : Procedure
        How the leg hits the front: where it stands, and what it wears.
    legform : Legform
    vehicle : Vehicle
    led : LedMotion
        Groups that it does not name stand still.

    Returns
    -------
    time : ndarray, shape (s,)
        From the record's start, s.
    forces : dict of str to ndarray, shape (s,)
        N, of the leg on each group.
    """
    rig = build(procedure, legform, vehicle)
    at = {body: _relative(led, track) for body, track in _leg_tracks(rig, led).items()}
    front = rig.front
    for name, body in () if front is None else front.groups.items():
        moved = led.groups.get(name, np.zeros_like(led.time))
        at[body] = np.column_stack([moved, np.zeros((led.time.size, 2))])
    poses = rig.assembly.finish().pose
    for body, moved in at.items():
        at[body] = moved + poses[body]
        start, points = add_tables(rig.assembly, led.time - led.time[0], at[body])
        mass, _, _, inertia = rig.assembly.masses()[body]
        rig.assembly.add(
            RecordedMotion(body=body, start=start, points=points, mass=float(mass), inertia=float(inertia))
        )
    world = rig.assembly.finish()
    pose, speed = world.pose.copy(), np.zeros_like(world.pose)
    interval = led.time[1] - led.time[0]
    for body, track in at.items():
        pose[body] = track[0]
        speed[body] = (track[1] - track[0]) / interval
    world = replace(world, pose=pose, speed=speed, pivots=world.pivots[:0], hinge=-1)
    probes = [world.place(*where) for where in rig.recorded.values()]
    until = float(led.time[-1] - led.time[0])
    run = run_world(world, Plan(STEP, until, 0.0, SAMPLE, FRAME), probes)
    readings = {name: run.readings[:, k] for k, name in enumerate(rig.recorded)}
    return run.time + led.time[0], contact_by_group(rig, readings)


def _relative(led: LedMotion, track: Floats) -> Floats:
    """Return how a track of x, z and angle departs from where it is at first contact, shape (n, 3)."""
    at = [np.interp(led.contact, led.time, track[:, k]) for k in range(3)]
    return track - np.array(at)


def _leg_tracks(rig: RigAssembly, led: LedMotion) -> dict[int, Floats]:
    """Return x, z and angle of every body of the leg by the points of the axis within it, shape (n, 3)."""
    heights = led.axis[:, 0, 1] - led.axis[0, 0, 1] + rig.leg.bottom
    tracks: dict[int, Floats] = {}
    for segment, body, centre in zip(rig.leg.segments, rig.leg.bodies, rig.leg.centres, strict=True):
        if body in tracks:
            continue
        inside = np.flatnonzero((heights > segment.bottom - WITHIN) & (heights < segment.top + WITHIN))
        if inside.size < 2:  # two points make a line
            middle = 0.5 * (segment.bottom + segment.top)
            inside = np.sort(np.argsort(np.abs(heights - middle))[:2])
        low, high = led.axis[inside[0]], led.axis[inside[-1]]
        along = high - low
        share = (centre - heights[inside[0]]) / (heights[inside[-1]] - heights[inside[0]])
        angle = np.unwrap(np.arctan2(-along[:, 0], along[:, 1]))
        tracks[body] = np.column_stack([low + share * along, angle])
    return tracks
