"""The ram of the inverse test: a guided mass with a honeycomb face."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.mechanics.laws import CRUSH
from certkit.mechanics.rigs.site import Site, box, strips

if TYPE_CHECKING:
    from certkit.definitions.legform import Flesh
    from certkit.definitions.rig import Ram

ELASTIC = 0.001
"""m: depth at which honeycomb reaches its crush strength, where the procedure names none."""


def fit_ram(site: Site, ram: Ram) -> None:
    """Let the ram touch the upright leg at full speed. Flesh, where fitted, is squeezed first."""
    top, height = float(ram.top_edge), float(ram.height)
    face = site.face(top, top - height)
    body = site.assembly.add_body(
        "ram", float(ram.mass), 0.0, (face, 0.0, 0.0), speed=(-float(ram.speed), 0.0, 0.0), guided=True
    )
    narrow = float(min(ram.width_on_knee, ram.width_on_bones))
    elastic = ELASTIC if ram.elastic_depth is None else float(ram.elastic_depth)
    if site.cover > 0:
        elastic += _squeeze(site.legform.flesh, float(ram.crush_strength) * narrow)
    for z, part in strips(top, height):
        site.assembly.add_row(
            CRUSH,
            (body,),
            {
                "face x": 0.0,
                "face z": z,
                "height": part,
                "strength": float(ram.crush_strength),
                "elastic depth": elastic,
                "thickness": site.cover,
            },
        )
    site.trigger = CRUSH
    site.longest = 0.01
    site.figures[body] = ("ram", box(0.0, float(ram.depth), top - height, top))


def _squeeze(flesh: Flesh, pressure: float) -> float:
    """Return the depth at which the flesh carries a force per unit height."""
    # d + d³/d₀² = p/k, by Cardano.
    limit = float(flesh.thickness)
    half = pressure / float(flesh.compression) * limit**2 / 2
    root = math.sqrt(half**2 + limit**6 / 27)
    return math.cbrt(half + root) + math.cbrt(half - root)
