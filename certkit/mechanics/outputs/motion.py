"""What the moving picture needs: outlines, their poses frame by frame, and what stands still."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from certkit.mechanics.fixtures.rig_assembly import Outline, Site, box

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics.legform.leg import Leg
    from certkit.mechanics.records import Floats, Integers
    from certkit.mechanics.solver.time_loop import Trajectory

Kind = Literal["bone", "knee", "flesh", "rig", "ram", "vehicle", "mass"]


@dataclass(frozen=True)
class Figure:
    """Something drawn: a closed polygon, in its body's axes or, where it stands still, in the world's.

    Parameters
    ----------
    name : str
    kind : str
        A `certkit.documents.result.Shape` kind.
    outline : tuple of (x, z)
        Metres.
    """

    name: str
    kind: Kind
    outline: Outline


@dataclass(frozen=True)
class RecordedMotion:
    """The test as a moving picture.

    Parameters
    ----------
    times : ndarray, shape (f,)
        Seconds after first contact.
    figures : tuple of Figure
        What moves.
    poses : ndarray, shape (f, figures, 3)
        x, z, angle of each.
    joints : tuple of str
        Names of the figures that `moments` colours: the bone segments.
    moments : ndarray, shape (f, joints)
        Bending moment in the middle of each, N·m.
    scene : tuple of Figure
        What never moves.
    """

    times: Floats
    figures: tuple[Figure, ...]
    poses: Floats
    joints: tuple[str, ...]
    moments: Floats
    scene: tuple[Figure, ...]


def film(
    site: Site, leg: Leg, run: Trajectory, readings: Mapping[str, Floats], at: Integers
) -> RecordedMotion:
    """Cut the frames of a run into a moving picture; `at` are the sample numbers of the frames."""
    figures: list[Figure] = []
    bodies: list[int] = []
    names: list[str] = []
    counts: dict[str, int] = {}
    moments: list[Floats] = []
    for i, (segment, body) in enumerate(zip(leg.segments, leg.bodies, strict=True)):
        counts[segment.part] = counts.get(segment.part, 0) + 1
        half = segment.depth / 2
        shape = box(-half, half, segment.bottom - segment.centre, segment.top - segment.centre)
        name = f"{segment.part} {counts[segment.part]}"
        figures.append(Figure(name, "knee" if segment.part == "knee" else "bone", shape))
        bodies.append(body)
        if segment.part != "knee":
            names.append(name)
            beside = [
                readings[f"joint {joint.row}"][at]
                for joint in leg.joints
                if abs(joint.height - segment.top) < 1e-9 or abs(joint.height - segment.bottom) < 1e-9
            ]
            free_end = i in {0, len(leg.segments) - 1}
            moments.append(np.asarray(sum(beside) / 2 if free_end else sum(beside) / len(beside)))
    for body, segment in zip(leg.flesh, leg.segments, strict=False):
        half = segment.depth / 2
        shape = box(half, half + site.cover, -segment.length / 2, segment.length / 2)
        figures.append(Figure(f"flesh {len(figures)}", "flesh", shape))
        bodies.append(body)
    for body, (name, shape) in site.figures.items():
        figures.append(Figure(name, "vehicle" if name in site.front else "ram", shape))
        bodies.append(body)
    poses = run.frames[:, bodies, :].copy()
    # Flesh is a point mass; it is drawn leaning with its bone.
    for k in range(len(leg.flesh)):
        poses[:, len(leg.segments) + k, 2] = poses[:, k, 2]
    return RecordedMotion(
        times=run.frame_time - run.contact,
        figures=tuple(figures),
        poses=poses,
        joints=tuple(names),
        moments=np.stack(moments, axis=1) if moments else np.zeros((len(run.frame_time), 0)),
        scene=tuple(Figure(name, "rig", shape) for name, shape in site.scene),
    )
