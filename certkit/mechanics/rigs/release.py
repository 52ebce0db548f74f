"""The release of the pendulum: let go above the horizontal, it swings about its hinge onto the stopper."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.errors import RunError
from certkit.mechanics.laws import CUSHION
from certkit.mechanics.rigs.site import GRAVITY, Site

if TYPE_CHECKING:
    from certkit.definitions.rig import Release


def fit_release(site: Site, release: Release) -> None:
    """Give the leg the speed of its fall at first contact, or lift it to its release angle.

    Raises
    ------
    RunError
        When there is no hinge to swing about.
    """
    hinge = site.rig.hinge
    if hinge is None:
        raise RunError("a release needs a hinge to swing about; add `hinge` to the rig")
    height = site.beyond(hinge.at, float(hinge.offset))
    down = 1.0 if hinge.at == "tibia end" else -1.0
    site.trigger = CUSHION
    if release.start == "full swing":
        # From hanging down back to above the horizontal, on the side away from the stopper.
        site.assembly.turn(down * (math.pi / 2 + release.angle), 0.0, height)
        site.longest = 3.0
        return
    mass, x, z, inertia = site.assembly.masses().T
    about_hinge = float((inertia + mass * (x**2 + (z - height) ** 2)).sum())
    arm = down * float((mass * (z - height)).sum())
    fall = GRAVITY * arm * (1 + math.sin(release.angle))
    site.assembly.spin(-down * math.sqrt(2 * fall / about_hinge), 0.0, height)
    site.longest = 0.01
