"""A link of a folding sheet between two groups: its force follows how far both are deformed.

The section force of a sheet that bends and folds is no function of the shortening x = X₁ - X₂ of its two
groups (m). Along the recorded path both are functions of the progress ξ = (X₁ + X₂)/2: a force F₀ and a
shortening x₀ (`recorded_path`). Off that path the sheet resists:

    F = F₀(ξ) + K·(x - x₀(ξ)) + c·d(x - x₀)/dt

with stiffness K (N/m) and damping c (N·s/m). The work of F₀ counts as dissipated, as folding is.

A contact that slides along a folding sheet only pushes, and off its path it is as stiff as it is loaded:

    F = max(F₀(ξ)·(1 + (K·(x - x₀) + c·d(x - x₀)/dt)/F_p) + K·max(ξ - ξ_end, 0), 0)

with the largest force F_p of its path, beyond the end ξ_end of which it goes on with K. All its work counts
as dissipated.

Source: momentum balances give the section force, step 3 of the seed paper (section 3); stiffness and damping
off the path are those of the vehicle document.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.compiling import compiled
from certkit.mechanics.force_laws.law import ForceLaw, Instant, Load, Totals
from certkit.mechanics.force_laws.recorded_path import on_joining_path

if TYPE_CHECKING:
    from certkit.mechanics.records import Body, Rows, State


class SheetLink(ForceLaw, kw_only=True):
    """One link of a sheet.

    Parameters
    ----------
    first, second : Body
    first_rest, second_rest : float
        Where they stand before they are moved, m.
    in_start, in_points, back_start, back_points : int
        The link's path, see `recorded_path`: x₀ and F₀ over ξ.
    stiffness, damping : float
        K and c.
    contact_force : float
        F_p (N) of a contact that only pushes; 0 for a link that pushes and pulls.
    largest : State
        Largest progress ξ so far, m.
    shortening, force : State
        x (m) and F (N) now.
    opening : State
        x - x₀ now, m.
    """

    first: Body
    second: Body
    first_rest: float
    second_rest: float
    in_start: int
    in_points: int
    back_start: int
    back_points: int
    stiffness: float
    damping: float
    contact_force: float = 0.0
    largest: State = 0.0
    shortening: State = 0.0
    force: State = 0.0
    opening: State = 0.0

    @staticmethod
    @compiled
    def forces(links: Rows[SheetLink], now: Instant, load: Rows[Load], totals: Totals) -> None:
        """Add the sheets' forces."""
        for i in range(len(links)):
            link = links[i]
            first = now.pose[link.first].x - link.first_rest
            second = now.pose[link.second].x - link.second_rest
            progress, shortening = 0.5 * (first + second), first - second
            link.largest = max(link.largest, progress)
            opening = shortening - on_joining_path(now.curves, link, 0, progress, link.largest)
            force = on_joining_path(now.curves, link, 1, progress, link.largest)
            off_path = link.stiffness * opening + link.damping * (opening - link.opening) / now.step
            stored = before = 0.0
            if link.contact_force > 0.0:
                force *= 1.0 + off_path / link.contact_force
                end = now.curves[link.in_start + link.in_points - 1].x
                force = max(force + link.stiffness * max(progress - end, 0.0), 0.0)
            else:
                force += off_path
                stored = 0.5 * link.stiffness * opening * opening
                before = 0.5 * link.stiffness * link.opening * link.opening
                totals.stored += stored
            totals.dissipated += 0.5 * (force + link.force) * (shortening - link.shortening) - stored + before
            load[link.first].x -= force
            load[link.second].x += force
            link.shortening = shortening
            link.force = force
            link.opening = opening
