"""What a finite-element run tells of its own quality: ratios of its energies, added mass, free flight."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from certkit.exchange.fe.run_histories import Samples

    Values = NDArray[np.float64]

ENERGY_RATIO = "energy ratio"
HOURGLASS = "hourglass energy"
CONTACT = "contact energy"
MASS_SCALING = "mass scaling"
FREE_FLIGHT = "free flight"
"""Names of the conditions; limits stand in the corridor set `virtual-test`."""

FOOT = 0.005
"""Share of the contact force's peak that marks first contact."""


def energy_conditions(energies: Mapping[str, Samples]) -> dict[str, float]:
    """Return the conditions that the run's energies and mass tell; what cannot be told is missing.

    Energy ratio: total energy over the initial total and the external work, where it is farthest from 1.
    Hourglass and contact energy: the largest and the farthest from 0, over the largest internal energy. Mass
    scaling: the largest added mass over the initial mass.
    """
    found: dict[str, float] = {}
    ratio = _ratio(energies)
    if ratio is not None and ratio.size:
        found[ENERGY_RATIO] = float(ratio[np.argmax(np.abs(ratio - 1.0))])
    internal = energies.get("internal")
    most = float(internal.values.max()) if internal is not None else 0.0
    if most > 0:
        if "hourglass" in energies:
            found[HOURGLASS] = float(energies["hourglass"].values.max()) / most
        if "contact" in energies:
            contact = energies["contact"].values
            found[CONTACT] = float(contact[np.argmax(np.abs(contact))]) / most
    added = _added_mass(energies)
    if added is not None:
        found[MASS_SCALING] = added
    return found


def _ratio(energies: Mapping[str, Samples]) -> Values | None:
    if "ratio" in energies:
        return energies["ratio"].values
    total = energies.get("total")
    if total is None:
        return None
    work = energies["external work"].at(total.time) if "external work" in energies else np.zeros(1)
    went_in = total.values[0] + work - work[0]
    return total.values / went_in if np.all(went_in > 0) else None


def _added_mass(energies: Mapping[str, Samples]) -> float | None:
    mass, added = energies.get("mass"), energies.get("added mass")
    if mass is None or not mass.values[0] > 0:
        return None
    grown = float(mass.values.max()) / float(mass.values[0]) - 1.0
    told = 0.0 if added is None else float(added.values.max()) / float(mass.values[0])
    return max(grown, told)


def contact_sample(force: Values) -> int | None:
    """Return the last sample before a contact force (N, shape (n,)) leaves zero; None where it never does.

    It leaves zero where it first exceeds 0.5 % of its peak; a run that begins in contact has its first
    sample there.
    """
    size = np.abs(force)
    peak = float(size.max()) if size.size else 0.0
    if not peak > 0:
        return None
    return max(0, int(np.argmax(size > FOOT * peak)) - 1)
