"""The groups of a front beside those of its run: how they move, and how they are pressed on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.bench.channel_checks import FREQUENCY_CLASS, percent_above
from certkit.bench.tried_check import TITLES
from certkit.documents.self_check import GroupCheck, SelfCheck
from certkit.signals.cfc import cfc

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from certkit.bench.checked_run import CheckedRun

    Values = NDArray[np.float64]

FINE = 1e-4
"""s: histories of coarser steps are interpolated, since the filter of the peaks asks for more."""
STILL = 0.1
"""Share of the largest movement of a face below which a face's error is not judged: it does not move."""


def group_checks(
    run: CheckedRun, key: str, moved: Mapping[str, Values], forces: Mapping[str, Values] | None = None
) -> SelfCheck:
    """Compare the groups' movement, and the contact force, its impulse and its work where they are known.

    Parameters
    ----------
    run : CheckedRun
    key : str
        Of the check.
    moved, forces : mapping of str to ndarray, shape (n,)
        Displacement (m) of each group, and the leg's force (N) on it, on the run's axis.
    """
    interval = float(run.time[1] - run.time[0])
    start, thinned, every = run.axis
    groups = []
    for group in run.result.groups:
        if group.name not in moved:
            continue
        x, wanted = moved[group.name], np.array(group.displacement[: run.time.size])
        largest = float(np.max(np.abs(wanted)))
        more: dict[str, float] = {}
        pressed: tuple[float, ...] = ()
        if forces is not None and group.name in run.contacts:
            force = forces.get(group.name, np.zeros_like(x))
            impulse, run_force = run.contacts[group.name]
            pressed = tuple(map(float, force[::every]))
            more = {
                "impulse": float(force.sum() * interval),
                "run_impulse": float(impulse[-1]),
                "work": float(np.trapezoid(force, x)),
                "run_work": float(np.trapezoid(run_force, wanted)),
                "force_peak": float(np.max(force)),
                "run_force_peak": float(np.max(run_force)),
            }
            if more["run_force_peak"] > 0:
                more["force_rms_percent"] = (
                    100 * float(np.sqrt(np.mean((force - run_force) ** 2))) / more["run_force_peak"]
                )
        groups.append(
            GroupCheck(
                name=group.name,
                peak=float(np.max(np.abs(x))),
                run_peak=largest,
                rms_percent=100 * float(np.sqrt(np.mean((x - wanted) ** 2))) / largest
                if largest > 0
                else 0.0,
                displacement=tuple(map(float, x[::every])),
                force=pressed,
                **more,
            )
        )
    faces = _judged(run, groups)
    judged = [g.rms_percent for g in groups if g.name in faces]
    worst = max(judged) if judged else None
    return SelfCheck(
        id=key,
        title=TITLES[key],
        start=start,
        interval=thinned,
        until=run.until,
        groups=tuple(sorted(groups, key=lambda g: (g.name not in faces, -g.rms_percent))),
        mean_percent=float(np.mean(judged)) if judged else None,
        worst_percent=worst,
        within=None if worst is None else worst <= run.settings.movement_limit,
    )


def _judged(run: CheckedRun, groups: list[GroupCheck]) -> set[str]:
    """Return the faces that move."""
    faces = {group.name for group in run.result.groups if group.position is not None}
    most = max((g.run_peak for g in groups if g.name in faces), default=0.0)
    return {g.name for g in groups if g.name in faces and g.run_peak >= STILL * most}


def contact_figures(run: CheckedRun, groups: Sequence[GroupCheck], force: Values) -> dict[str, float | None]:
    """Return the errors of a contact force (N, on the run's axis), of its impulse and of where it acts, %."""
    total = sum((f for _, f in run.contacts.values()), np.zeros_like(run.time))
    interval = float(run.time[1] - run.time[0])
    wanted = float(sum(i[-1] for i, _ in run.contacts.values()))
    fine = np.arange(run.time[0], run.time[-1], min(interval, FINE))
    peaks = [
        float(cfc(np.interp(fine, run.time, values), float(fine[1] - fine[0]), FREQUENCY_CLASS).max())
        for values in (force, total)
    ]
    wrong = sum(abs((g.impulse or 0.0) - (g.run_impulse or 0.0)) for g in groups)
    return {
        "force_percent": percent_above(*peaks),
        "impulse_percent": percent_above(float(force.sum() * interval), wanted),
        "wrong_group_percent": 50.0 * wrong / wanted if wanted > 0 else None,
    }
