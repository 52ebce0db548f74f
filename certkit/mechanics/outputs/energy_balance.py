"""How far a run can be trusted: energy balance, joint gap, penetration."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.documents.result import Histories, Series
from certkit.documents.rounding import rounded_series
from certkit.mechanics.force_laws import ENERGY_ACCOUNTS

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.mechanics.records import Floats
    from certkit.mechanics.solver.time_loop import Trajectory
    from certkit.signals import Recording

MOST_POINTS_OF_ENERGY = 300
"""Points that a drawing of energies needs."""


class RunQuality(Struct, frozen=True):
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
    flesh_depth_percent : float
        Largest depth of the flesh over its thickness; 0 where no flesh is compressed.
    steps : int
    time_step : float
    iterations : int
        Of pymunk's constraint solver.
    energies : mapping of str to ndarray, shape (samples,)
        `kinetic`, and what each law stored and dissipated, J: `joint spring stored`, …
    imbalance : ndarray, shape (samples,)
        J.
    """

    energy_error_percent: float
    joint_gap_mm: float
    penetration_mm: float
    flesh_depth_percent: float
    steps: int
    time_step: float
    iterations: int
    energies: Mapping[str, Floats]
    imbalance: Floats


def run_quality(run: Trajectory, time_step: float, iterations: int) -> RunQuality:
    """Return the quality figures of a run."""
    stored = run.stored - run.stored[0]
    dissipated = run.dissipated - run.dissipated[0]
    total = run.kinetic + stored.sum(axis=1) + dissipated.sum(axis=1)
    imbalance = total - total[0]
    # What was turned over: all accounts that took, or the kinetic energy brought in, whichever is larger.
    accounts = np.concatenate([run.kinetic[:, None] - run.kinetic[0], stored, dissipated], axis=1)
    turned = max(float(np.clip(accounts, 0, None).sum(axis=1).max()), float(run.kinetic[0]))
    energies = {"kinetic": run.kinetic}
    for a, name in enumerate(ENERGY_ACCOUNTS):
        for kind, account in (("stored", stored[:, a]), ("dissipated", dissipated[:, a])):
            if np.any(account):
                energies[f"{name} {kind}"] = account
    return RunQuality(
        energy_error_percent=100 * float(np.abs(imbalance).max()) / turned if turned > 0 else 0.0,
        joint_gap_mm=1e3 * run.joint_gap,
        penetration_mm=1e3 * run.penetration,
        flesh_depth_percent=round(1e2 * run.flesh_depth, 6),
        steps=run.steps,
        time_step=time_step,
        iterations=iterations,
        energies=energies,
        imbalance=imbalance,
    )


def energy_histories(quality: RunQuality, recording: Recording) -> Histories | None:
    """Return the energies over time, thinned out; None for static tests, whose clock means nothing."""
    count, samples = len(quality.imbalance), len(recording.time)
    if samples < 2 or count < MOST_POINTS_OF_ENERGY:
        return None
    every = -(-count // MOST_POINTS_OF_ENERGY)
    return Histories(
        # Energies begin at the start of the run, which may lie before first contact.
        start=-recording.interval * (count - samples),
        interval=recording.interval * every,
        count=len(range(0, count, every)),
        series={
            name: Series(title=name, unit="J", values=rounded_series(values[::every]))
            for name, values in quality.energies.items()
        },
    )
