"""Three-point bending: rollers fixed in space, a ram that presses at mid-span in a staircase of levels."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.errors import RunError
from certkit.mechanics.laws import LOADING, NOSE, SUPPORTS
from certkit.mechanics.rigs.site import Site, disc
from certkit.mechanics.world import GROUND

if TYPE_CHECKING:
    from certkit.definitions.rig import LoadingRam, Supports

RAMP = 0.010
HOLD = 0.050
"""s: from one level to the next, and how long a level is held until the specimen is at rest."""
DRAG = 400.0
"""1/s: mass damping that brings it to rest; it has no part in the answer at rest."""
STIFFNESS = 2e7
"""N/m: of rollers and of the ram's nose. Their own penetration is taken off the deflection."""
NOSE_RADIUS = 0.050
"""m, of the loading ram (R 50 in the drawings of the knee test)."""
REACH = 0.050
"""m: massless rigid ends that carry a specimen shorter than the span."""


def schedule(ram: LoadingRam) -> tuple[tuple[float, float], ...]:
    """Return the staircase: (time, force) corners."""
    corners = [(0.0, 0.0)]
    for level in range(ram.levels):
        start = corners[-1][0]
        force = ram.force * (level + 1) / ram.levels
        corners += [(start + RAMP, force), (start + RAMP + HOLD, force)]
    return tuple(corners)


def middle(site: Site) -> float:
    """Return the height of mid-span: half the bone, or the knee centre."""
    part = site.leg.segments[0].part
    return (site.leg.top + site.leg.bottom) / 2 if part != "knee" else 0.0


def fit_supports(site: Site, supports: Supports) -> None:
    """Set the two rollers at half the span above and below mid-span.

    Raises
    ------
    RunError
        When they are too far from the specimen's ends.
    """
    half, centre = float(supports.span) / 2, middle(site)
    ends = site.leg.top - centre, centre - site.leg.bottom
    reach = max(half - min(ends), 0.0) + REACH
    if reach > half:
        raise RunError(f"a span of {supports.span * 1e3:g} mm is too long for the specimen; check `supports`")
    site.reach = reach
    for z in (centre + half, centre - half):
        site.assembly.add_row(
            SUPPORTS,
            (GROUND,),
            {"station": z, "stiffness": STIFFNESS, "damping": 0.0},
        )
        site.scene.append(("support", disc(-0.075 - site.face(z + 0.2, z - 0.2), z, 0.075)))


def fit_loading_ram(site: Site, ram: LoadingRam) -> None:
    """Let the ram press at mid-span; at the knee its nose leans on both blocks.

    Raises
    ------
    RunError
        When nothing carries the specimen.
    """
    if site.rig.supports is None:
        raise RunError("a loading ram needs rollers that carry the specimen; add `supports` to the rig")
    site.assembly.schedule = schedule(ram)
    centre = middle(site)
    if site.leg.segments[0].part != "knee":
        site.assembly.add_row(LOADING, (GROUND,), {"station": centre, "start": 0.0})
        return
    face = site.face(centre + 0.01, centre - 0.01)
    body = site.assembly.add_body(
        "loading ram", 1.0, 0.0, (face + NOSE_RADIUS, centre, 0.0), guided=True, drag=DRAG
    )
    for block in site.leg.bodies:
        site.assembly.add_row(
            NOSE, (body, block), {"radius": NOSE_RADIUS, "face": face, "stiffness": STIFFNESS, "damping": 0.0}
        )
    site.assembly.add_row(LOADING, (body,), {"station": centre, "start": face + NOSE_RADIUS})
    nose = disc(0.0, 0.0, NOSE_RADIUS)[6:19]  # its half towards the specimen
    site.figures[body] = ("loading ram", (*nose, (0.15, -NOSE_RADIUS), (0.15, NOSE_RADIUS)))
