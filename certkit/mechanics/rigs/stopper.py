"""The stop bar of the pendulum: a fixed upright face of some height that the flesh is squeezed against."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.mechanics.laws import CUSHION
from certkit.mechanics.rigs.site import Site, box, strips
from certkit.mechanics.world import GROUND

if TYPE_CHECKING:
    from certkit.definitions.rig import Stopper

BARE = 1e8
"""N/m²: stiffness per unit length of a bare bone on a rigid bar."""


def fit_stopper(site: Site, stopper: Stopper) -> None:
    """Put the bar where the leg, hanging straight, just touches it."""
    flesh = site.legform.flesh
    height, middle = float(stopper.height), -float(stopper.below_knee_centre)
    face = site.face(middle + height / 2, middle - height / 2)
    softness = 1 / flesh.compression if site.cover > 0 else 1 / BARE
    if stopper.stiffness is not None:
        softness += height / stopper.stiffness
    for z, part in strips(middle + height / 2, height):
        site.assembly.add_row(
            CUSHION,
            (GROUND,),
            {
                "face x": face,
                "face z": z,
                "height": part,
                "compression": 1 / softness,
                "stiffening depth": float(flesh.thickness),
                "thickness": site.cover,
            },
        )
    site.scene.append(("stopper", box(face, face + 0.06, middle - height / 2, middle + height / 2)))
