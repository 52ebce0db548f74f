"""Pins to the rig: the hinge of the pendulum, the hanger of the inverse test."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.rigs.site import GRAVITY, Site, disc
from certkit.mechanics.world import GROUND

if TYPE_CHECKING:
    from certkit.definitions.rig import Hanger, Hinge


def fit_hinge(site: Site, hinge: Hinge) -> None:
    """Pin the leg to the rig beyond one end; it hangs from there."""
    _pin(site, hinge.at, float(hinge.offset), "hinge")


def fit_hanger(site: Site, hanger: Hanger) -> None:
    """Hang the leg up by one end; during the impact it stays pinned, or is free (and so weightless)."""
    if hanger.hold == "pinned":
        _pin(site, hanger.at, 0.0, "hanger")


def _pin(site: Site, end: str, offset: float, name: str) -> None:
    height = site.beyond(end, offset)
    site.assembly.hinge = site.assembly.add_pivot(site.end_body(end), GROUND, 0.0, height)
    # The rest of the leg hangs below the pin: for a pinned tibia end "down" points to the femur.
    site.assembly.gravity = (0.0, GRAVITY if end == "tibia end" else -GRAVITY)
    site.scene.append((name, disc(0.0, height, 0.012)))
