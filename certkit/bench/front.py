"""What a vehicle's front did in a run, for the result document: face forces, connections, energies."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.documents.result import CurveInPlane, Front, Histories, Series

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics import Simulation
    from certkit.mechanics.records import Floats

MOST = 300
"""Points that a picture of a history needs."""


def front(simulation: Simulation) -> Front | None:
    """Write down what the front did, thinned out; None where no vehicle was hit."""
    done = simulation.front
    if done is None:
        return None
    interval = simulation.recording.interval
    every = max(1, -(-len(done.time) // MOST))

    def histories(values: Mapping[str, Floats], unit: str, scale: float) -> Histories:
        return Histories(
            start=0.0,
            interval=interval * every,
            count=len(range(0, len(done.time), every)),
            series={
                name: Series(title=name, unit=unit, values=(scale * v[::every]).tolist())
                for name, v in values.items()
            },
        )

    touched = {name: force for name, force in done.contact.items() if force.max() > 0}
    return Front(
        contact=histories(touched, "N", 1.0),
        displacement=histories(done.displacement, "mm", 1e3),
        springs={
            name: CurveInPlane(
                x_title="shortening",
                x_unit="mm",
                y_title="force",
                y_unit="N",
                points=[(1e3 * float(a), float(b)) for a, b in zip(x[::every], force[::every], strict=True)],
            )
            for name, (x, force) in done.springs.items()
            if np.any(force)
        },
        received={
            name: float(np.trapezoid(force, done.displacement[name])) for name, force in touched.items()
        },
        absorbed={
            name: float(np.trapezoid(force, x)) for name, (x, force) in done.springs.items() if np.any(force)
        },
    )
