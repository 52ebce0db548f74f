"""A vehicle's front without a leg, driven by recorded contact forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.mechanics.rig.front_groups import add_groups
from certkit.mechanics.rig.recorded_forces import add_recorded
from certkit.mechanics.solver.time_loop import Plan, run_world
from certkit.mechanics.solver.world import Assembly

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.vehicle import Vehicle
    from certkit.mechanics.records import Floats
    from certkit.mechanics.rig.recorded_forces import RecordedForce

STEP = 1e-5
"""s: half the step of a vehicle run, since a front's groups are lighter than a leg's segments."""

SAMPLE, FRAME = 5, 100


class DrivenFront(Struct, frozen=True):
    """What a front did under given forces.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Seconds from the record's start.
    displacement : mapping of str to ndarray
        Of each group along x, m.
    links : mapping of str to (ndarray, ndarray)
        Shortening (m) and force (N) of each spring and sheet.
    """

    time: Floats
    displacement: Mapping[str, Floats]
    links: Mapping[str, tuple[Floats, Floats]]


def drive_front(vehicle: Vehicle, forces: Sequence[RecordedForce], until: float) -> DrivenFront:
    """Drive a front without a leg by recorded contact forces.

    Parameters
    ----------
    vehicle : Vehicle
    forces : sequence of RecordedForce
        Those on groups that the vehicle does not have are left out.
    until : float
        Seconds from the record's start.

    Raises
    ------
    RunError
        When a group runs away.
    """
    assembly = Assembly()
    bodies, links = add_groups(assembly, vehicle, 0.0)
    for recorded in forces:
        if recorded.group in bodies:
            add_recorded(assembly, recorded, bodies[recorded.group])
    world = assembly.finish()
    probes = [world.place(link.law, link.row, state) for link in links for state in ("shortening", "force")]
    run = run_world(world, Plan(STEP, until, 0.0, SAMPLE, FRAME), probes, tuple(bodies.values()))
    return DrivenFront(
        time=run.time,
        displacement={n: run.tracks[:, k, 0] - run.tracks[0, k, 0] for k, n in enumerate(bodies)},
        links={
            link.name: (run.readings[:, 2 * k], run.readings[:, 2 * k + 1]) for k, link in enumerate(links)
        },
    )
