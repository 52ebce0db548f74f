"""The round nose of the loading ram on the flat face of a knee block: penalty contact.

Force F = max(k·d + c·ḋ, 0) along x, with the penetration d = r + e - a of a nose of radius r whose centre
stands a from the block's axis, e the distance of the block's face from it (m), stiffness k (N/m) and
damping c (N·s/m).

What the contact's normal would add along the leg is taken by friction on the neoprene sheet, and the work
of that friction is counted as dissipated.

Source: penalty contact; the knee test's ram has a round nose and one neoprene sheet under it (UN R127,
annex 6).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class RamNoseContact(ForceLaw, kw_only=True):
    """One ram on one block.

    Parameters
    ----------
    ram, block : Body
    radius : float
        r, m.
    face : float
        e, m.
    stiffness, damping : float
        k (N/m) and c (N·s/m).
    depth, force : State
        d (m) and F (N) now; d is negative where the two are apart.
    """

    ram: Body
    block: Body
    radius: float
    face: float
    stiffness: float
    damping: float = 0.0
    depth: State = 0.0
    force: State = 0.0

    @staticmethod
    @compiled
    def forces(contacts: Rows[RamNoseContact], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the contact of nose and blocks."""
        for i in range(len(contacts)):
            contact = contacts[i]
            ram, block = now.pose[contact.ram], now.pose[contact.block]
            c, s = block.cos, block.sin
            dx = ram.x - block.x
            dz = ram.z - block.z
            depth = contact.radius + contact.face - (c * dx + s * dz)
            contact.depth = depth
            contact.force = 0.0
            if depth <= 0.0:
                continue
            of_ram, of_block = now.velocity[contact.ram], now.velocity[contact.block]
            vx = of_ram.x - of_block.x
            vz = of_ram.z - of_block.z
            closing = -(c * vx + s * vz + of_block.angular * (c * dz - s * dx))
            elastic = contact.stiffness * depth
            force = max(elastic + contact.damping * closing, 0.0)
            # Height of the contact above the block's centre of gravity.
            lever = dz - contact.radius * s
            load[contact.block].x -= force
            load[contact.block].torque += force * lever
            load[contact.ram].x += force
            work_rate = force * (of_ram.x - of_block.x + of_block.angular * lever)
            totals.stored += 0.5 * elastic * depth
            totals.power += -work_rate - elastic * closing
            totals.penetration = max(totals.penetration, depth)
            contact.force = force
