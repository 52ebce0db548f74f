"""The leg's face as obstacles see it: which segment stands at a height, and how far forward.

Obstacles are cut into strips of constant height in space. A strip looks up the segment at its height, so
its force passes smoothly from segment to segment as the leg tilts and slides. Forces follow the gradient of
the depth, which makes them normal to the face and conservative.
"""

from __future__ import annotations

from certkit.mechanics.force_laws.law import COS, SIN, Scene, X, Z
from certkit.mechanics.solver.compiling import compiled

STEEPEST = 0.3  # cosine: a segment that leans more than about 70° is not met by any obstacle


@compiled
def row_at(scene: Scene, z: float, row: int) -> int:
    """Return the first outline row at or below `row` that stands at height `z`; -1 where there is none.

    Strips must come from top to bottom, each starting from the row of the one above it.
    """
    pose, outline = scene.pose, scene.outline
    last = scene.outline_body.shape[0]
    while row < last:
        body = scene.outline_body[row]
        if pose[body, COS] < STEEPEST:
            return -1
        if z >= pose[body, Z] + outline[row, 1] * pose[body, COS]:
            above = z > pose[body, Z] + outline[row, 0] * pose[body, COS]
            return -1 if above and row == 0 else row
        row += 1
    return -1


@compiled
def face_at(scene: Scene, row: int, z: float, thickness: float) -> tuple[float, float, float]:
    """Return where the face stands at height `z`, and how that follows the segment's pose.

    Returns
    -------
    x, by_height, by_angle : float
        Place of the face (m), and its derivatives by the segment's height and angle (by its x: one).
    """
    pose = scene.pose
    body = scene.outline_body[row]
    c = pose[body, COS]
    tangent = pose[body, SIN] / c
    lever = z - pose[body, Z]
    off = (scene.outline[row, 2] + thickness) / c
    return pose[body, X] - lever * tangent + off, tangent, off * tangent - lever / (c * c)
