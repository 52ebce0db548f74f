"""A knee ligament: a wire cable on a preloaded spring, which pulls and never pushes.

Tension T = max(F₀ + k·e, 0) + c·ė, never below zero, with the elongation e = l - l₀ over the length at rest
(m), preload F₀ (N), stiffness k (N/m) and damping c (N·s/m), along the line between its two attachments.
The damper acts only while the spring is tight. Stored energy max(F₀ + k·e, 0)²/(2k).

The same law is the tension of the flesh's outer cover from one piece of flesh to the next.

Source: the knee blocks are held together by spring wires (seed paper, section 2.1.2); their elastic law is
taken as linear.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class LigamentCable(ForceLaw, kw_only=True):
    """One cable.

    Parameters
    ----------
    upper, lower : Body
    upper_x, upper_z, lower_x, lower_z : float
        Its attachments in each body's frame, from the centre of gravity, m.
    length : float
        l₀, m.
    stiffness : float
        k, N/m.
    preload : float
        F₀, N.
    damping : float
        c, N·s/m.
    elongation, tension : State
        e (m) and T (N) now.
    """

    upper: Body
    lower: Body
    upper_x: float = 0.0
    upper_z: float = 0.0
    lower_x: float = 0.0
    lower_z: float = 0.0
    length: float
    stiffness: float
    preload: float = 0.0
    damping: float = 0.0
    elongation: State = 0.0
    tension: State = 0.0

    @staticmethod
    @compiled
    def forces(cables: Rows[LigamentCable], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the cables' tensions."""
        stored = power = 0.0
        for i in range(len(cables)):
            cable = cables[i]
            a, b = cable.upper, cable.lower
            upper, lower = now.pose[a], now.pose[b]
            # Attachments from each body's centre of gravity, in space.
            ax = upper.cos * cable.upper_x - upper.sin * cable.upper_z
            az = upper.sin * cable.upper_x + upper.cos * cable.upper_z
            bx = lower.cos * cable.lower_x - lower.sin * cable.lower_z
            bz = lower.sin * cable.lower_x + lower.cos * cable.lower_z
            dx = upper.x + ax - lower.x - bx
            dz = upper.z + az - lower.z - bz
            length = math.sqrt(dx * dx + dz * dz)
            ux, uz = dx / length, dz / length
            elongation = length - cable.length
            va, vb = now.velocity[a], now.velocity[b]
            lengthening = (va.x - va.angular * az - vb.x + vb.angular * bz) * ux + (
                va.z + va.angular * ax - vb.z - vb.angular * bx
            ) * uz
            elastic = cable.preload + cable.stiffness * elongation
            elastic = max(elastic, 0.0)
            tension = elastic + cable.damping * lengthening if elastic > 0.0 else 0.0
            tension = max(tension, 0.0)
            power += (tension - elastic) * lengthening
            if cable.stiffness > 0.0:
                stored += 0.5 * elastic * elastic / cable.stiffness
            else:
                stored += elastic * elongation
            on_upper, on_lower = load[a], load[b]
            on_upper.x -= tension * ux
            on_upper.z -= tension * uz
            on_upper.torque -= tension * (ax * uz - az * ux)
            on_lower.x += tension * ux
            on_lower.z += tension * uz
            on_lower.torque += tension * (bx * uz - bz * ux)
            cable.elongation = elongation
            cable.tension = tension
        totals.stored += stored
        totals.power += power
