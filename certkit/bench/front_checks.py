"""The self-checks of an extraction: the front alone, the leg alone, and both together, beside their run.

The front alone, driven by the run's own contact forces, shows what the springs are worth. The leg alone,
driven by the same forces, shows what the leg is worth. Only where both agree is an agreement of the coupled
run a prediction and no compensation.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np

from certkit.bench.channel_checks import FREQUENCY_CLASS, POINTS, channel_checks, error_percent
from certkit.bench.contact_places import recorded_forces
from certkit.bench.front_frames import front_motion
from certkit.bench.path_checks import path_checks
from certkit.bench.setup import prepare
from certkit.bench.tried_check import TITLES, tried
from certkit.documents.self_check import GroupCheck, SelfCheck
from certkit.identification.vehicle_file import vehicle_text
from certkit.signals.cfc import cfc

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from certkit.bench.setup import Setup
    from certkit.definitions.extraction_case import Case
    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.front_motion import FrontMotion
    from certkit.exchange.fe import FrontData

    Values = NDArray[np.float64]

PROCEDURE = "vehicle-fe-front"
UNTIL = 0.045
"""s: later a leg hardly touches a front."""
FINE = 1e-4
"""s: histories of coarser steps are interpolated, since the filter of the peaks asks for more."""
STILL = 0.1
"""Share of the largest movement of a face below which a face's error is not judged: it does not move."""


@dataclass(frozen=True)
class _Run:
    """What the finite-element run says, on the uniform axis of the extraction up to the checks' end."""

    result: ExtractionResult
    data: FrontData
    until: float
    limit: float

    @property
    def time(self) -> Values:
        """Return the axis, shape (n,), s."""
        times = np.array(self.result.times)
        return times[times <= self.until]

    @property
    def contacts(self) -> dict[str, tuple[Values, Values]]:
        """Return impulse (N·s) and force (N) of the impactor on each group, shape (n,) each."""
        impactors = {group.name for group in self.result.groups if group.kind == "impactor"}
        n = self.time.size
        return {
            path.target: (np.array(path.impulse[:n]), np.array(path.force[:n]))
            for path in self.result.paths
            if path.source in impactors
        }

    @property
    def start(self) -> float:
        """Return the instant of first contact, s."""
        total = sum((impulse for impulse, _ in self.contacts.values()), np.zeros_like(self.time))
        begun = np.flatnonzero(total > 1e-6 * float(np.max(np.abs(total))))
        return float(self.time[max(int(begun[0]) - 1, 0)]) if begun.size else 0.0


def self_checks(
    case: Case,
    data: FrontData,
    result: ExtractionResult,
    *,
    procedure: str | Path = PROCEDURE,
    tell: Callable[[str], None] = lambda _: None,
) -> tuple[tuple[SelfCheck, ...], FrontMotion | None]:
    """Hold an extraction to its run.

    Parameters
    ----------
    case : Case
    data : FrontData
        The histories that the extraction came from.
    result : ExtractionResult
    procedure : str or Path
        Which leg hits the front, and how.
    tell : callable, optional
        Told what is being done.

    Returns
    -------
    tuple of SelfCheck
        The front alone; where the run tells what its leg did, also the leg alone and both.
    FrontMotion or None
        Of the last; None where there is none.

    A run that does not come to its end is a check that failed, and says why.
    """
    settings = case.settings
    until = UNTIL if settings.check_until is None else float(settings.check_until)
    run = _Run(result, data, min(until, result.times[-1]), settings.movement_limit)
    if not any(group.position is not None for group in result.groups) or not run.contacts:
        return (), None
    with TemporaryDirectory() as folder:
        vehicle = Path(folder) / "vehicle.yaml"
        vehicle.write_text(vehicle_text(result), encoding="utf-8")
        setup = prepare(procedure, overrides={"vehicle": str(vehicle)})
    axis = _axis(run)[:2]
    tell("self-check: the front alone")
    checks = [tried("front alone", axis, run.until, lambda: _front_alone(run, setup))]
    if not data.histories.leg:  # the impactor was no leg, or nothing is known of it
        return tuple(checks), None
    tell("self-check: the leg alone")
    checks.append(tried("leg alone", axis, run.until, lambda: _leg_alone(run, setup)))
    tell("self-check: leg and front")
    motions: list[FrontMotion | None] = [None]

    def coupled() -> SelfCheck:
        check, motions[0] = _coupled(run, setup)
        return check

    checks.append(tried("coupled", axis, run.until, coupled))
    return tuple(checks), motions[0]


def _front_alone(run: _Run, setup: Setup) -> SelfCheck:
    from certkit.mechanics.recorded_drive import drive_front  # noqa: PLC0415  # a solver, only here

    if setup.vehicle is None:
        raise ValueError("a front is checked with a procedure that hits a vehicle")
    forces = recorded_forces(run.result, None, face=0.0, thickness=1.0)
    driven = drive_front(setup.vehicle, forces, run.until)
    moved = {name: np.interp(run.time, driven.time, x) for name, x in driven.displacement.items()}
    return _checked(run, "front alone", moved)


def _leg_alone(run: _Run, setup: Setup) -> SelfCheck:
    from certkit.mechanics import simulate  # noqa: PLC0415  # a solver, only here

    flesh = setup.legform.flesh
    half = 0.5 * max(float(bone.depth) for bone in setup.legform.parts.values())
    face = half if flesh.face is None else float(flesh.face)
    forces = recorded_forces(run.result, run.data.motion, face=face, thickness=float(flesh.thickness))
    done = simulate(setup.procedure, setup.legform, driven=forces)
    start, interval, _ = _axis(run)
    return SelfCheck(
        id="leg alone",
        title=TITLES["leg alone"],
        start=start,
        interval=interval,
        until=run.until,
        channels=channel_checks(run.data, done, start=run.start, until=run.until),
    )


def _coupled(run: _Run, setup: Setup) -> tuple[SelfCheck, FrontMotion | None]:
    from certkit.mechanics import simulate  # noqa: PLC0415  # a solver, only here

    done = simulate(setup.procedure, setup.legform, vehicle=setup.vehicle)
    front = done.front
    if front is None or setup.vehicle is None:
        raise ValueError("a front is checked with a procedure that hits a vehicle")
    time = (
        run.start
        + front.displacement.start
        + front.displacement.interval * np.arange(front.displacement.count)
    )
    moved = {
        name: np.interp(run.time, time, 1e-3 * np.array(series.values))
        for name, series in front.displacement.series.items()
    }
    forces = {
        name: np.interp(run.time, time, np.array(series.values), left=0.0)
        for name, series in front.contact.series.items()
    }
    check = _checked(run, "coupled", moved, forces)
    recording = done.recording
    force = np.interp(run.time, run.start + recording.time, recording["contact force"].values, left=0.0)
    total = sum((f for _, f in run.contacts.values()), np.zeros_like(run.time))
    interval = float(run.time[1] - run.time[0])
    impulse, wanted = float(force.sum() * interval), float(sum(i[-1] for i, _ in run.contacts.values()))
    impactor = next(group for group in run.result.groups if group.kind == "impactor")
    left = impactor.momentum[run.time.size - 1]
    fine = np.arange(run.time[0], run.time[-1], min(interval, FINE))
    peaks = [
        float(cfc(np.interp(fine, run.time, values), float(fine[1] - fine[0]), FREQUENCY_CLASS).max())
        for values in (force, total)
    ]
    wrong = sum(abs((g.impulse or 0.0) - (g.run_impulse or 0.0)) for g in check.groups)
    channels = channel_checks(run.data, done, start=run.start, until=run.until)
    every = _axis(run)[2]
    paths = path_checks(run.result, setup.vehicle, done, start=run.start, time=run.time, every=every)
    motion = front_motion(
        run.result, run.data.motion, done, setup.legform, moved, channels, time=run.time, start=run.start
    )
    whole = check.model_copy(
        update={
            "channels": channels,
            "paths": paths,
            "force_percent": error_percent(*peaks),
            "impulse_percent": error_percent(impulse, wanted),
            "rebound_percent": error_percent(impactor.momentum[0] - impulse, left) if left != 0 else None,
            "wrong_group_percent": 50.0 * wrong / wanted if wanted > 0 else None,
        }
    )
    return whole, motion


def _checked(
    run: _Run, key: str, moved: Mapping[str, Values], forces: Mapping[str, Values] | None = None
) -> SelfCheck:
    """Compare the groups' movement, and the impulse and work on each where the forces are known."""
    interval = float(run.time[1] - run.time[0])
    start, thinned, every = _axis(run)
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
            }
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
        within=None if worst is None else worst <= run.limit,
    )


def _judged(run: _Run, groups: list[GroupCheck]) -> set[str]:
    """Return the faces that move."""
    faces = {group.name for group in run.result.groups if group.position is not None}
    most = max((g.run_peak for g in groups if g.name in faces), default=0.0)
    return {g.name for g in groups if g.name in faces and g.run_peak >= STILL * most}


def _axis(run: _Run) -> tuple[float, float, int]:
    """Return start and interval of the series that are kept, and of how many instants one is."""
    every = max(1, run.time.size // POINTS)
    return float(run.time[0]), float(run.time[1] - run.time[0]) * every, every
