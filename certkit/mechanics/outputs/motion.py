"""The motion of a run for the moving drawing: outlines, their poses frame by frame, and what stands still."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.legform import KNEE
from certkit.documents.rig_motion import Motion, Shape
from certkit.mechanics.fixtures.rig_assembly import box
from certkit.mechanics.outputs.recorded_channels import moment_at

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics.fixtures.rig_assembly import RigAssembly
    from certkit.mechanics.records import Floats, Integers
    from certkit.mechanics.solver.time_loop import Trajectory


def recorded_motion(
    rig: RigAssembly, run: Trajectory, readings: Mapping[str, Floats], at: Integers
) -> Motion:
    """Return the motion document of a run; `at` are the sample numbers of the frames.

    A segment of a bone is coloured by the bending moment in its middle, the mean of its two joints'; at a
    free end the moment is zero.
    """
    leg = rig.leg
    shapes: list[Shape] = []
    bodies: list[int] = []
    names: list[str] = []
    counts: dict[str, int] = {}
    moments: list[Floats] = []
    for segment, body, centre in zip(leg.segments, leg.bodies, leg.centres, strict=True):
        counts[segment.part] = counts.get(segment.part, 0) + 1
        half = segment.depth / 2
        outline = box(-half, half, segment.bottom - centre, segment.top - centre)
        name = f"{segment.part} {counts[segment.part]}"
        shapes.append(Shape(name=name, kind="knee" if segment.part == KNEE else "bone", outline=outline))
        bodies.append(body)
        if segment.part != KNEE:
            names.append(name)
            middle = (segment.top + segment.bottom) / 2
            moments.append(moment_at(leg, readings, middle, segment.part)[at])
    for body, segment in zip(leg.flesh, leg.segments, strict=False):
        # Where the far side has a mass of its own, that of the impact side is in its middle, not on the axis.
        inner = rig.bone_face(segment) if rig.legform.flesh.far_side is None else -rig.cover / 2
        outline = box(inner, inner + rig.cover, -segment.length / 2, segment.length / 2)
        shapes.append(Shape(name=f"flesh {len(shapes)}", kind="flesh", outline=outline))
        bodies.append(body)
    shapes += rig.moving_shapes.values()
    bodies += rig.moving_shapes
    poses = run.frames[:, bodies, :].copy()
    # Flesh is a point mass; it is drawn tilted with its bone.
    for k in range(len(leg.flesh)):
        poses[:, len(leg.segments) + k, 2] = poses[:, k, 2]
    coloured = np.stack(moments, axis=1) if moments else np.zeros((len(run.frame_time), 0))
    return Motion(
        times=(run.frame_time - run.contact).tolist(),
        shapes=shapes,
        poses=poses.tolist(),
        joints=names,
        moments=coloured.tolist(),
        scene=rig.fixed_shapes,
    )
