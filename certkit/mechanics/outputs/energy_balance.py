"""How far a run can be trusted: energy balance, joint gap, penetration."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from certkit.mechanics.force_laws import ENERGY_ACCOUNTS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics.records import Floats
    from certkit.mechanics.solver.time_loop import Trajectory


@dataclass(frozen=True)
class RunQuality:
    """Quality figures of one run.

    Parameters
    ----------
    energy_error_percent : float
        Largest imbalance over the energy turned over: the most that was kinetic, stored, spent or brought
        in at once.
    joint_gap_mm : float
        Largest distance between the two halves of a pivot.
    penetration_mm : float
        Deepest penetration of condyles, supports and ram nose.
    steps : int
    time_step : float
    iterations : int
        Of pymunk's constraint solver.
    energies : mapping of str to ndarray, shape (samples,)
        `kinetic`, and what each law stored and spent, J: `joint springs stored`, `joint springs spent`, …
    imbalance : ndarray, shape (samples,)
        J.
    """

    energy_error_percent: float
    joint_gap_mm: float
    penetration_mm: float
    steps: int
    time_step: float
    iterations: int
    energies: Mapping[str, Floats]
    imbalance: Floats


def judge(run: Trajectory, time_step: float, iterations: int) -> RunQuality:
    """Return the quality figures of a run."""
    stored = run.stored - run.stored[0]
    spent = run.dissipated - run.dissipated[0]
    total = run.kinetic + stored.sum(axis=1) + spent.sum(axis=1)
    imbalance = total - total[0]
    # What was turned over: all books that took, or all that gave, whichever is larger.
    books = np.concatenate([run.kinetic[:, None] - run.kinetic[0], stored, spent], axis=1)
    turned = max(float(np.clip(books, 0, None).sum(axis=1).max()), float(run.kinetic[0]))
    energies = {"kinetic": run.kinetic}
    for b, name in enumerate(ENERGY_ACCOUNTS):
        for kind, book in (("stored", stored[:, b]), ("spent", spent[:, b])):
            if np.any(book):
                energies[f"{name} {kind}"] = book
    return RunQuality(
        energy_error_percent=100 * float(np.abs(imbalance).max()) / turned if turned > 0 else 0.0,
        joint_gap_mm=1e3 * run.joint_gap,
        penetration_mm=1e3 * run.penetration,
        steps=run.steps,
        time_step=time_step,
        iterations=iterations,
        energies=energies,
        imbalance=imbalance,
    )
