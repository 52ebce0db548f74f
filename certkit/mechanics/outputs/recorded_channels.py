"""From a trajectory to channels: gauges between joints, ligaments, knee, forces, curves of a bending test."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from certkit.mechanics.fixtures.fixture_model import model_of
from certkit.mechanics.force_laws.joint_spring import JointSpring
from certkit.mechanics.force_laws.ligament_cable import LigamentCable
from certkit.signals import CHANNELS, Channel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.legform import Gauges
    from certkit.mechanics.fixtures.rig_assembly import RigAssembly
    from certkit.mechanics.legform.leg import Leg
    from certkit.mechanics.records import Floats
    from certkit.mechanics.solver.time_loop import Trajectory
    from certkit.mechanics.solver.world import World


def stations(gauges: Gauges) -> dict[str, float]:
    """Return the height of each strain gauge above the knee centre."""
    above = {"F1": gauges.f1, "F2": gauges.f2, "F3": gauges.f3}
    below = {"T1": gauges.t1, "T2": gauges.t2, "T3": gauges.t3, "T4": gauges.t4}
    return {**{k: float(v) for k, v in above.items()}, **{k: -float(v) for k, v in below.items()}}


def probes(world: World, leg: Leg, rig: RigAssembly) -> dict[str, int]:
    """Return what to record, by a name of its own: where each state stands in the world's tables."""
    places = {f"joint {joint.row}": world.place(JointSpring, joint.row, "moment") for joint in leg.joints}
    places |= {name: world.place(LigamentCable, row, "elongation") for name, row in leg.ligaments.items()}
    if leg.knee_row >= 0:
        places["knee bend"] = world.place(JointSpring, leg.knee_row, "angle")
    places |= {name: world.place(*where) for name, where in rig.recorded.items()}
    return places


def moment_at(leg: Leg, readings: Mapping[str, Floats], height: float, part: str) -> Floats:
    """Interpolate a bone's bending moment at a height between its joints; it is zero at the free end."""
    bone = [segment for segment in leg.segments if segment.part == part]
    known = {joint.height: readings[f"joint {joint.row}"] for joint in leg.joints if joint.part == part}
    for end in (bone[0].top, bone[-1].bottom):
        if not any(math.isclose(end, h, abs_tol=1e-9) for h in known):
            known[end] = np.zeros_like(next(iter(known.values())))
    heights = sorted(known, reverse=True)
    for upper, lower in pairwise(heights):
        if lower <= height <= upper:
            share = (height - lower) / (upper - lower)
            return share * known[upper] + (1 - share) * known[lower]
    raise ValueError(f"height {height} m is not on the {part}")


def channels(
    rig: RigAssembly, leg: Leg, run: Trajectory, readings: Mapping[str, Floats]
) -> dict[str, Channel]:
    """Return all channels of the run: gauges, ligaments, knee, and what the fixtures add."""
    values: dict[str, Floats] = {}
    parts = {segment.part for segment in leg.segments}
    if parts == {"femur", "knee", "tibia"}:
        for name, height in stations(rig.legform.gauges).items():
            values[name] = moment_at(leg, readings, height, "femur" if height > 0 else "tibia")
    values |= {name: readings[name] for name in leg.ligaments}
    if leg.knee_row >= 0:
        values["knee bend"] = readings["knee bend"]
        values["knee shear"] = _shear(leg, run)
        if rig.rig.test_kind != "static":
            values["knee acceleration"] = run.accelerations[:, 1, 0]
    if rig.contact_law is not None:
        values["contact force"] = run.contact_force
    if rig.assembly.hinge >= 0:
        values["hinge force"] = run.hinge_force

    def bone_moment(height: float, part: str) -> Floats:
        return moment_at(leg, readings, height, part)

    for fixture in rig.rig.fixtures():
        values |= model_of(fixture).channels(rig, readings, bone_moment)
    return {
        name: Channel(name, CHANNELS[name].title, CHANNELS[name].dimension, series)
        for name, series in values.items()
    }


def _shear(leg: Leg, run: Trajectory) -> Floats:
    """Return how far the tibia block has moved towards the obstacle against the femur block."""
    upper, lower = run.tracks[:, 0], run.tracks[:, 1]
    blocks = [segment for segment in leg.segments if segment.part == "knee"]
    knee = []
    for pose, block in ((upper, blocks[0]), (lower, blocks[1])):
        x = pose[:, 0] + np.sin(pose[:, 2]) * block.centre
        z = pose[:, 1] - np.cos(pose[:, 2]) * block.centre
        knee.append((x, z))
    dx, dz = knee[1][0] - knee[0][0], knee[1][1] - knee[0][1]
    return np.asarray(np.cos(lower[:, 2]) * dx + np.sin(lower[:, 2]) * dz)
