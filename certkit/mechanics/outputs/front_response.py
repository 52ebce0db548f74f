"""What the front of a vehicle did in a run: forces on its faces, movement of its groups, its springs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from certkit.mechanics.force_laws.vehicle_front_contact import VehicleFrontContact
from certkit.mechanics.force_laws.vehicle_spring import VehicleSpring

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics.fixtures.rig_assembly import Site
    from certkit.mechanics.records import Floats
    from certkit.mechanics.solver.time_loop import Trajectory
    from certkit.mechanics.solver.world import World


@dataclass(frozen=True)
class FrontHistories:
    """Histories of a vehicle's front over the recording's time axis, SI.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Seconds after first contact.
    contact : mapping of str to ndarray
        Force of the leg on each group's face, N.
    displacement : mapping of str to ndarray
        Of each group along x, m.
    springs : mapping of str to (ndarray, ndarray)
        Shortening (m) and force (N) of each spring, by its name.
    """

    time: Floats
    contact: Mapping[str, Floats]
    displacement: Mapping[str, Floats]
    springs: Mapping[str, tuple[Floats, Floats]]


def front_probes(world: World, site: Site) -> dict[str, int]:
    """Return what to record of a front, by a name of its own: where each reading stands in the state pool."""
    places = {f"strip {k}": world.place(VehicleFrontContact, k, "force") for k in range(len(site.strips))}
    for k in range(len(site.springs)):
        places[f"spring {k} shortening"] = world.place(VehicleSpring, k, "shortening")
        places[f"spring {k} force"] = world.place(VehicleSpring, k, "force")
    return places


def front_histories(site: Site, run: Trajectory, readings: Mapping[str, Floats]) -> FrontHistories | None:
    """Gather the front's histories from first contact on; None where there is no front."""
    if not site.front:
        return None
    first = int(np.searchsorted(run.time, run.contact - 1e-12))
    contact: dict[str, Floats] = {}
    for k, strip in enumerate(site.strips):
        force = readings[f"strip {k}"][first:]
        for name, share in ((strip.lower, 1 - strip.share), (strip.upper, strip.share)):
            if share > 0:
                contact[name] = contact.get(name, 0.0) + share * force
    offset = run.tracks.shape[1] - len(site.front)
    displacement = {
        name: run.tracks[first:, offset + k, 0] - run.tracks[0, offset + k, 0]
        for k, name in enumerate(site.front)
    }
    springs = {
        name: (readings[f"spring {k} shortening"][first:], readings[f"spring {k} force"][first:])
        for k, name in enumerate(site.springs)
    }
    return FrontHistories(run.time[first:] - run.time[first], contact, displacement, springs)
