"""How long a time step the damping of a leg's joints allows.

The loop knows the speed between two steps and extrapolates it for damping, which is stable while λ·Δt < 1.
λ is the largest rate at which the joints' damping alone slows the turning of the segments: the largest
eigenvalue of I⁻¹·C, with I the segments' inertias and C the tridiagonal matrix of the joints' damping.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.legform import KNEE
from certkit.mechanics.legform.bone_joint import is_rigid, jointed_bone, part_joint

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.definitions.legform import Legform
    from certkit.mechanics.legform.segments import Segment

BOUND = 0.97
"""Of λ·Δt: a little below one, for what the leg's other springs and dampers add."""
PARTS = 10
"""A leg that needs more of them has a number that nobody meant; its run tells so."""


def stable_step(wanted: float, legform: Legform, segments: Sequence[Segment], *, flesh: bool) -> float:
    """Return `wanted` (s), or the largest whole part of it that the joints' damping allows."""
    count = len(segments)
    damping = np.zeros((count, count))
    for i, pair in enumerate(pairwise(segments)):
        damping[i : i + 2, i : i + 2] += _damping(legform, *pair, flesh=flesh) * np.array([[1, -1], [-1, 1]])
    root = np.sqrt([segment.inertia for segment in segments])
    fastest = float(np.linalg.eigvalsh(damping / np.outer(root, root))[-1])
    return wanted / min(max(1, math.ceil(fastest * wanted / BOUND)), PARTS)


def _damping(legform: Legform, upper: Segment, lower: Segment, *, flesh: bool) -> float:
    """Return the damping of the joint between two segments, N·m·s/rad.

    None between the knee blocks. Rigidly held segments are one body: without damping between them each counts
    as lighter than it is, which is on the safe side.
    """
    if upper.part == lower.part == KNEE or is_rigid(legform, upper.part, lower.part):
        return 0.0
    joint = part_joint(legform, upper.part, lower.part)
    if joint is not None:
        return float(joint.stiffness * joint.damping_time)
    bone, factor = jointed_bone(legform, upper.part, lower.part)
    damping = bone.bending_stiffness * bone.damping_time
    if flesh:
        damping += (legform.flesh.bending_stiffness or 0.0) * (legform.flesh.damping_time or 0.0)
    return float(factor * damping * bone.segments / bone.length)
