"""A guide between the knee blocks: they slide freely against each other for a way, then a spring holds them.

Force F = max(k·(|s| - s₀) + c·d|s|/dt, 0) against the slide, beyond the free travel s₀ either way (m), with
stiffness k (N/m) and damping c (N·s/m). The slide s is measured across the lower block, at one point of each
block. Both blocks meet the force on one line, so that momentum is kept. Stored energy ½·k·(|s| - s₀)².

Source: a gap and a linear spring, the simplest law of a guide with play; its numbers stand with their origin
in the legform document.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class SlidingGuide(ForceLaw, kw_only=True):
    """One guide.

    Parameters
    ----------
    upper, lower : Body
    upper_x, upper_z : float
        The upper block's point from its centre of gravity, m.
    lower_x : float
        Distance of the lower block's guide from its axis, m.
    free_travel : float
        s₀, m.
    stiffness, damping : float
        k (N/m) and c (N·s/m).
    slide, force : State
        s (m) and F with its sign (N) now.
    """

    upper: Body
    lower: Body
    upper_x: float
    upper_z: float
    lower_x: float
    free_travel: float
    stiffness: float
    damping: float
    slide: State = 0.0
    force: State = 0.0

    @staticmethod
    @compiled
    def forces(guides: Rows[SlidingGuide], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the guides' forces."""
        for i in range(len(guides)):
            guide = guides[i]
            a, b = guide.upper, guide.lower
            upper, lower = now.pose[a], now.pose[b]
            c, s = lower.cos, lower.sin
            # The upper block's point, from each centre of gravity.
            ax = upper.cos * guide.upper_x - upper.sin * guide.upper_z
            az = upper.sin * guide.upper_x + upper.cos * guide.upper_z
            bx = upper.x + ax - lower.x
            bz = upper.z + az - lower.z
            slide = c * bx + s * bz - guide.lower_x
            guide.slide = slide
            guide.force = 0.0
            excess = abs(slide) - guide.free_travel
            if excess <= 0.0:
                continue
            va, vb = now.velocity[a], now.velocity[b]
            vx = va.x - va.angular * az - vb.x + vb.angular * bz
            vz = va.z + va.angular * ax - vb.z - vb.angular * bx
            opening = c * vx + s * vz
            way = 1.0 if slide > 0.0 else -1.0
            elastic = guide.stiffness * excess
            bearing = max(elastic + guide.damping * way * opening, 0.0)
            fx, fz = -way * bearing * c, -way * bearing * s
            on_upper, on_lower = load[a], load[b]
            on_upper.x += fx
            on_upper.z += fz
            on_upper.torque += ax * fz - az * fx
            on_lower.x -= fx
            on_lower.z -= fz
            on_lower.torque -= bx * fz - bz * fx
            totals.stored += 0.5 * elastic * excess
            totals.power += (bearing - elastic) * way * opening
            guide.force = way * bearing
