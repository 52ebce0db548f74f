"""The motion of a run for the moving drawing: outlines, their poses frame by frame, and what stands still."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.fixtures.rig_outlines import box
from certkit.definitions.legform import KNEE
from certkit.documents.rig_motion import Motion, Shape
from certkit.mechanics.outputs.recorded_channels import moment_at

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics.records import Floats, Integers
    from certkit.mechanics.rig.rig_assembly import RigAssembly
    from certkit.mechanics.solver.time_loop import Trajectory


def recorded_motion(
    rig: RigAssembly, run: Trajectory, readings: Mapping[str, Floats], at: Integers
) -> Motion:
    """Return the motion document of a run, m and rad; `at`, shape (frames,), has the frames' sample numbers.

    The picture is turned so that z points up in the laboratory.

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
    shapes += [shape for _, shape in rig.moving_shapes]
    bodies += [body for body, _ in rig.moving_shapes]
    poses = run.frames[:, bodies, :].copy()
    # Flesh is a point mass; it is drawn tilted with its bone.
    for k in range(len(leg.flesh)):
        poses[:, len(leg.segments) + k, 2] = poses[:, k, 2]
    for shape, (x, z), travel in rig.pushed_shapes:
        shapes.append(shape)
        pushed = np.stack([x - readings[travel][at], np.full(len(at), z), np.zeros(len(at))], axis=-1)
        poses = np.concatenate([poses, pushed[:, None, :]], axis=1)
    turn = math.pi / 2 - math.atan2(rig.up[1], rig.up[0])
    coloured = np.stack(moments, axis=1) if moments else np.zeros((len(run.frame_time), 0))
    return Motion(
        times=(run.frame_time - run.contact).tolist(),
        shapes=shapes,
        poses=turned_poses(poses, turn).tolist(),
        joints=names,
        moments=coloured.tolist(),
        scene=[turned_shape(shape, turn) for shape in rig.fixed_shapes],
        before=[turned_shape(shape, turn) for shape in rig.released_shapes],
        gravity=float(np.hypot(*rig.assembly.gravity)),
    )


def turned_poses(poses: Floats, angle: float) -> Floats:
    """Return poses after the whole picture is turned by `angle` (rad) about the knee centre.

    Poses have the shape (…, 3): x and z (m), angle (rad).
    """
    c, s = math.cos(angle), math.sin(angle)
    x, z, own = np.moveaxis(poses, -1, 0)
    return np.stack([c * x - s * z, s * x + c * z, own + angle], axis=-1)


def turned_shape(shape: Shape, angle: float) -> Shape:
    """Return a shape in world axes, turned with the whole picture."""
    if angle == 0.0:
        return shape
    c, s = math.cos(angle), math.sin(angle)
    return shape.model_copy(update={"outline": [(c * x - s * z, s * x + c * z) for x, z in shape.outline]})
