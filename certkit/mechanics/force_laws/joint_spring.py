"""Bending of a bone: a rotational spring and damper between two segments, stiffer beyond the cables' slack.

Moment M = k·φ + k_c·sign(φ)·max(|φ| - φ_c, 0) + c·φ̇ with the angle φ of the lower against the upper body,
k = EI/h for segments of height h (N·m/rad), the steel cables' stiffness k_c beyond the angle φ_c (rad) and
damping c (N·m·s/rad). Stored energy ½·k·φ² + ½·k_c·max(|φ| - φ_c, 0)².

The moment is positive when the impact side (+x) is in compression: the lower body has turned more than the
upper.

Source: a beam of bending stiffness EI cut into rigid segments, each joint with the curvature of one
segment; four steel cables in each segment prevent over-bending (seed paper, section 2.1.1).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class JointSpring(ForceLaw, kw_only=True):
    """One joint.

    Parameters
    ----------
    upper, lower : Body
    stiffness : float
        k, N·m/rad.
    damping : float
        c, N·m·s/rad.
    cable_angle : float
        φ_c, rad.
    cable_stiffness : float
        k_c, N·m/rad; none where there is no cable.
    moment, angle : State
        M (N·m) and φ (rad) now.
    """

    upper: Body
    lower: Body
    stiffness: float
    damping: float
    cable_angle: float = math.pi
    cable_stiffness: float = 0.0
    moment: State = 0.0
    angle: State = 0.0

    @staticmethod
    @compiled
    def forces(joints: Rows[JointSpring], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the joints' moments."""
        stored = power = 0.0
        for i in range(len(joints)):
            joint = joints[i]
            upper, lower = joint.upper, joint.lower
            angle = now.pose[lower].angle - now.pose[upper].angle
            rate = now.velocity[lower].angular - now.velocity[upper].angular
            excess = abs(angle) - joint.cable_angle
            moment = joint.stiffness * angle
            stored += 0.5 * joint.stiffness * angle * angle
            if excess > 0.0:
                moment += joint.cable_stiffness * excess if angle > 0.0 else -joint.cable_stiffness * excess
                stored += 0.5 * joint.cable_stiffness * excess * excess
            damping = joint.damping * rate
            power += damping * rate
            moment += damping
            load[lower].torque -= moment
            load[upper].torque += moment
            joint.moment = moment
            joint.angle = angle
        totals.stored += stored
        totals.power += power
