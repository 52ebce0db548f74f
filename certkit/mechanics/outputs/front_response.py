"""What the front of a vehicle did in a run: forces on its faces, movement of its groups, its springs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.documents.result import CurveInPlane, Front, Histories, Series
from certkit.documents.rounding import rounded_series

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics.records import Floats
    from certkit.mechanics.rig.rig_assembly import RigAssembly
    from certkit.mechanics.solver.time_loop import Trajectory

MOST_POINTS_OF_FRONT = 300
"""Points that a drawing of a history needs."""


def front_response(rig: RigAssembly, run: Trajectory, readings: Mapping[str, Floats]) -> Front | None:
    """Return the front's histories from first contact on, thinned out; None where no vehicle was hit.

    What a face received from the leg is ∫F dx over the movement of its group, what a spring absorbed ∫F dx
    over its shortening, both over all samples. `readings`, SI, have the shape (samples,).
    """
    if rig.front is None:
        return None
    first = int(np.searchsorted(run.time, run.contact - 1e-12))
    time = run.time[first:] - run.time[first]
    every = max(1, -(-len(time) // MOST_POINTS_OF_FRONT))
    contact = contact_by_group(rig, readings)
    touched = {name: force[first:] for name, force in contact.items() if force[first:].max() > 0}
    offset = run.tracks.shape[1] - len(rig.front.groups)
    displacement = {
        name: run.tracks[first:, offset + k, 0] - run.tracks[0, offset + k, 0]
        for k, name in enumerate(rig.front.groups)
    }
    springs = {
        name: (readings[f"spring {name} shortening"][first:], readings[f"spring {name} force"][first:])
        for name in rig.front.links
        if np.any(readings[f"spring {name} force"][first:])
    }

    def histories(values: Mapping[str, Floats], unit: str, scale: float) -> Histories:
        return Histories(
            start=0.0,
            interval=float(time[1] - time[0]) * every,
            count=len(range(0, len(time), every)),
            series={
                name: Series(title=name, unit=unit, values=rounded_series(scale * v[::every]))
                for name, v in values.items()
            },
        )

    return Front(
        contact=histories(touched, "N", 1.0),
        displacement=histories(displacement, "mm", 1e3),
        springs={name: _curve(x[::every], force[::every]) for name, (x, force) in springs.items()},
        received={name: float(np.trapezoid(force, displacement[name])) for name, force in touched.items()},
        absorbed={name: float(np.trapezoid(force, x)) for name, (x, force) in springs.items()},
    )


def contact_by_group(rig: RigAssembly, readings: Mapping[str, Floats]) -> dict[str, Floats]:
    """Return the leg's force on each group of the front, N, shape (samples,)."""
    front = rig.front
    contact: dict[str, Floats] = {}
    if front is None:
        return contact
    strips = [(f"strip {k}", s.lower, s.upper, s.share) for k, s in enumerate(front.strips)]
    strips += [(f"folding strip {k}", *of) for k, of in enumerate(front.folding)]
    for strip, group, partner, of_partner in strips:
        force = readings[f"{strip} force"]
        for name, share in ((group, 1 - of_partner), (partner, of_partner)):
            if share > 0:
                contact[name] = contact.get(name, 0.0) + share * force
    return contact


def _curve(shortening: Floats, force: Floats) -> CurveInPlane:
    return CurveInPlane(
        x_title="shortening",
        x_unit="mm",
        y_title="force",
        y_unit="N",
        points=list(zip((1e3 * shortening).tolist(), force.tolist(), strict=True)),
    )
