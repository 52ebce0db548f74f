"""From a trajectory to channels: gauges between joints, ligaments, knee, forces, curves of a bending test."""

from __future__ import annotations

import math
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.legform import KNEE
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.force_laws.ligament_cable import LigamentCable
from certkit.signals import Channel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics.legform.leg import Leg
    from certkit.mechanics.records import Floats
    from certkit.mechanics.rig.rig_assembly import RigAssembly
    from certkit.mechanics.solver.time_loop import Trajectory
    from certkit.mechanics.solver.world import World


def probes(world: World, rig: RigAssembly) -> dict[str, int]:
    """Return what to record, by a name of its own: where each state stands in the world's tables."""
    leg = rig.leg
    places = {f"joint {joint.row}": world.place(JointSpring, joint.row, "moment") for joint in leg.joints}
    places |= {f"angle {joint.row}": world.place(JointSpring, joint.row, "angle") for joint in leg.joints}
    places |= {
        f"ligament {name}": world.place(LigamentCable, row, "elongation")
        for name, row in leg.ligaments.items()
    }
    if leg.knee_row >= 0:
        places["knee bend"] = world.place(JointSpring, leg.knee_row, "angle")
    places |= {name: world.place(*where) for name, where in rig.recorded.items()}
    return places


def moment_at(leg: Leg, readings: Mapping[str, Floats], height: float, part: str) -> Floats:
    """Interpolate the bending moment at a height between joints; it is zero at a free end.

    Parts on the same side of the knee are one bar, whether they are joined rigidly or by a joint.

    Parameters
    ----------
    leg : Leg
        Its joints have the gauges.
    readings : mapping of str to ndarray, shape (samples,)
        Moment of each joint, N·m, by `joint ROW`.
    height : float
        Above the knee centre, m.
    part : str
        The part that the height is on.

    Returns
    -------
    ndarray, shape (samples,)
        N·m.
    """
    runs = [
        list(run) for knee, run in groupby(leg.segments, lambda segment: segment.part == KNEE) if not knee
    ]
    bar = next(run for run in runs if any(segment.part == part for segment in run))
    top, bottom = bar[0].top, bar[-1].bottom
    known = {
        joint.height: readings[f"joint {joint.row}"]
        for joint in leg.joints
        if bottom - 1e-9 <= joint.height <= top + 1e-9
    }
    for end in (top, bottom):
        if not any(math.isclose(end, h, abs_tol=1e-9) for h in known):
            known[end] = np.zeros_like(next(iter(known.values())))
    heights = sorted(known, reverse=True)
    for upper, lower in pairwise(heights):
        if lower <= height <= upper:
            share = (height - lower) / (upper - lower)
            return share * known[upper] + (1 - share) * known[lower]
    raise ValueError(f"height {height} m is not on the {part}")


def channels(rig: RigAssembly, run: Trajectory, readings: Mapping[str, Floats]) -> dict[str, Channel]:
    """Return all channels of the run, SI, shape (samples,), in the order of the legform's table."""
    table = rig.legform.channel_table
    values = {**_of_legform(rig, run, readings), **_of_rig(rig, run, readings)}
    return {
        name: Channel(name, kind.title, kind.dimension, values[name])
        for name, kind in table.kinds.items()
        if name in values
    }


def _of_legform(rig: RigAssembly, run: Trajectory, readings: Mapping[str, Floats]) -> dict[str, Floats]:
    """Return what the legform's own channels show; bending moments of a whole leg only."""
    legform, leg = rig.legform, rig.leg
    whole = {segment.part for segment in leg.segments} == set(legform.chain)
    knee: dict[str, Floats] = {}
    if leg.knee_row >= 0:
        knee = {"bending angle": readings["knee bend"], "shear displacement": _shear(leg, run)}
        if rig.rig.test_kind != "static":
            knee["acceleration"] = run.accelerations[:, 1, 0]
    values: dict[str, Floats] = {}
    for name, channel in legform.channels.items():
        if channel.measures == "bending moment" and whole:
            values[name] = moment_at(leg, readings, legform.gauge_height(channel), channel.part or "")
        elif channel.ligament in leg.ligaments:
            values[name] = readings[f"ligament {channel.ligament}"]
        elif channel.measures in knee:
            values[name] = knee[channel.measures]
    return values


def _of_rig(rig: RigAssembly, run: Trajectory, readings: Mapping[str, Floats]) -> dict[str, Floats]:
    """Return what the fixtures measure."""
    values: dict[str, Floats] = {}
    if rig.contact_law is not None:
        values["contact force"] = run.contact_force
    if rig.assembly.hinge >= 0:
        values["hinge force"] = run.hinge_force

    def bone_moment(height: float, part: str) -> Floats:
        return moment_at(rig.leg, readings, height, part)

    for fixture in rig.rig.fixtures():
        values |= fixture.channel_values(rig, readings, bone_moment)
    return values


def _shear(leg: Leg, run: Trajectory) -> Floats:
    """Return how far the tibia block has moved towards the obstacle against the femur block."""
    upper, lower = run.tracks[:, 0], run.tracks[:, 1]
    blocks = [segment for segment in leg.segments if segment.part == KNEE]
    knee = []
    for pose, block in ((upper, blocks[0]), (lower, blocks[1])):
        x = pose[:, 0] + np.sin(pose[:, 2]) * block.centre
        z = pose[:, 1] - np.cos(pose[:, 2]) * block.centre
        knee.append((x, z))
    dx, dz = knee[1][0] - knee[0][0], knee[1][1] - knee[0][1]
    return np.asarray(np.cos(lower[:, 2]) * dx + np.sin(lower[:, 2]) * dz)
