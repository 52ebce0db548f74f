"""A round condyle in a round trough: penalty contact with Coulomb friction.

Normal force N = max(k·d + c·ḋ, 0) with the penetration d, the distance between the two centres less the
difference of the two radii (m), stiffness k (N/m) and damping c (N·s/m).

Friction is a tangential spring of stiffness k_t that slips where it would exceed μ·N (Cundall and Strack,
Géotechnique 29, 1979). Unlike friction smoothed over the sliding speed it holds a load at rest, which the
static tests need. Its length over a step is the exact relative displacement; slip dissipates the mean of the
spring forces before and after, times the slip.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class CondyleContact(ForceLaw, kw_only=True):
    """One condyle in its trough.

    Parameters
    ----------
    upper, lower : Body
        The body with the condyle and the body with the trough.
    condyle_x, condyle_z, trough_x, trough_z : float
        The centres of their circles in each body's frame, m.
    clearance : float
        Radius of the trough less that of the condyle, m.
    radius : float
        Of the condyle, m.
    stiffness, damping : float
        k (N/m) and c (N·s/m).
    friction : float
        μ.
    tangential_stiffness : float
        k_t, N/m.
    slip_spring : State
        Stretch of the tangential spring, m: remembered from step to step.
    penetration : State
        d now, m; negative where the two are apart.
    """

    upper: Body
    lower: Body
    condyle_x: float
    condyle_z: float
    trough_x: float
    trough_z: float
    clearance: float
    radius: float
    stiffness: float
    damping: float
    friction: float
    tangential_stiffness: float
    slip_spring: State = 0.0
    penetration: State = 0.0

    @staticmethod
    @compiled
    def forces(  # one contact, force by force
        contacts: Rows[CondyleContact], now: Instant, load: Rows[Load], totals: Totals
    ) -> None:
        """Add contact and friction of the condyles."""
        for i in range(len(contacts)):
            contact = contacts[i]
            a, b = contact.upper, contact.lower
            upper, lower = now.pose[a], now.pose[b]
            # Centre of the condyle and of the trough, from each body's centre of gravity.
            ax = upper.cos * contact.condyle_x - upper.sin * contact.condyle_z
            az = upper.sin * contact.condyle_x + upper.cos * contact.condyle_z
            bx = lower.cos * contact.trough_x - lower.sin * contact.trough_z
            bz = lower.sin * contact.trough_x + lower.cos * contact.trough_z
            dx = upper.x + ax - lower.x - bx
            dz = upper.z + az - lower.z - bz
            distance = math.sqrt(dx * dx + dz * dz)
            depth = distance - contact.clearance
            contact.penetration = depth
            if depth <= 0.0:
                contact.slip_spring = 0.0
                continue
            nx, nz = dx / distance, dz / distance
            # The point of contact, from each centre of gravity.
            pax, paz = ax + contact.radius * nx, az + contact.radius * nz
            pbx = upper.x + pax - lower.x
            pbz = upper.z + paz - lower.z
            va, vb = now.velocity[a], now.velocity[b]
            vx = va.x - va.angular * paz - vb.x + vb.angular * pbz
            vz = va.z + va.angular * pax - vb.z - vb.angular * pbx
            closing = vx * nx + vz * nz
            elastic = contact.stiffness * depth
            normal = elastic + contact.damping * closing
            normal = max(normal, 0.0)
            tx, tz = -nz, nx
            sa, sb = now.step_velocity[a], now.step_velocity[b]
            mx = sa.x - sa.angular * paz - sb.x + sb.angular * pbz
            mz = sa.z + sa.angular * pax - sb.z - sb.angular * pbx
            spring = contact.slip_spring + (mx * tx + mz * tz) * now.step
            stiffness = contact.tangential_stiffness
            limit = contact.friction * normal / stiffness
            held = min(max(spring, -limit), limit)
            # Slip, under the mean of the forces before and after: exact both for steady sliding and where a
            # falling normal force makes a resting contact creep.
            totals.dissipated += 0.5 * stiffness * (contact.slip_spring + held) * (spring - held)
            friction = stiffness * held
            fx = -normal * nx - friction * tx
            fz = -normal * nz - friction * tz
            on_upper, on_lower = load[a], load[b]
            on_upper.x += fx
            on_upper.z += fz
            on_upper.torque += pax * fz - paz * fx
            on_lower.x -= fx
            on_lower.z -= fz
            on_lower.torque -= pbx * fz - pbz * fx
            totals.stored += 0.5 * elastic * depth + 0.5 * friction * held
            totals.power += (normal - elastic) * closing
            totals.penetration = max(totals.penetration, depth)
            contact.slip_spring = held
