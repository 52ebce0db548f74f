"""The self-checks of an extraction: the front alone, the leg alone, and both together, beside their run.

The front alone, driven by the run's own contact forces, shows what the springs are worth. The leg alone,
driven by the same forces, shows what the leg is worth. Only where both agree is an agreement of the coupled
run a prediction and no compensation.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from certkit.bench.channel_checks import FREQUENCY_CLASS, channel_checks, error_percent
from certkit.bench.checked_run import CheckedRun
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
FINE = 1e-4
"""s: histories of coarser steps are interpolated, since the filter of the peaks asks for more."""
STILL = 0.1
"""Share of the largest movement of a face below which a face's error is not judged: it does not move."""


class HeldToRun(NamedTuple):
    """Self-checks of an extraction, the frames of the coupled one, and what there is to say of them."""

    checks: tuple[SelfCheck, ...]
    motion: FrontMotion | None = None
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


def self_checks(
    case: Case,
    data: FrontData,
    result: ExtractionResult,
    *,
    procedure: str | Path = PROCEDURE,
    tell: Callable[[str], None] = lambda _: None,
) -> HeldToRun:
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
    HeldToRun
        The front alone; where the run tells what its leg did, also the leg alone and both. The leg flies as
        in the run, whatever the procedure says.

    A run that does not come to its end is a check that failed, and says why.
    """
    run = CheckedRun(result, data, case.settings)
    if not any(group.position is not None for group in result.groups) or not run.contacts:
        return HeldToRun(())
    with TemporaryDirectory() as folder:
        vehicle = Path(folder) / "vehicle.yaml"
        vehicle.write_text(vehicle_text(result), encoding="utf-8")
        setup = prepare(procedure, overrides={"vehicle": str(vehicle)})
        setup = prepare(procedure, overrides={"vehicle": str(vehicle), **run.flight(setup.procedure)})
    axis = run.axis[:2]
    tell("self-check: the front alone")
    checks = [tried("front alone", axis, run.until, lambda: _front_alone(run, setup))]
    if not data.histories.leg:  # the impactor was no leg, or nothing is known of it
        return HeldToRun(tuple(checks))
    tell("self-check: the leg alone")
    checks.append(tried("leg alone", axis, run.until, lambda: _leg_alone(run, setup)))
    tell("self-check: leg and front")
    motions: list[FrontMotion | None] = [None]

    def coupled() -> SelfCheck:
        check, motions[0] = _coupled(run, setup)
        return check

    checks.append(tried("coupled", axis, run.until, coupled))
    warnings, notes = run.flight_remarks(setup.procedure, setup.legform)
    return HeldToRun(tuple(checks), motions[0], tuple(warnings), tuple(notes))


def _front_alone(run: CheckedRun, setup: Setup) -> SelfCheck:
    from certkit.mechanics.recorded_drive import drive_front  # noqa: PLC0415  # a solver, only here

    if setup.vehicle is None:
        raise ValueError("a front is checked with a procedure that hits a vehicle")
    forces = recorded_forces(run.result, None, face=0.0, thickness=1.0)
    driven = drive_front(setup.vehicle, forces, run.until - run.result.start)
    axis = driven.time + run.result.start
    moved = {name: np.interp(run.time, axis, x) for name, x in driven.displacement.items()}
    return _checked(run, "front alone", moved)


def _leg_alone(run: CheckedRun, setup: Setup) -> SelfCheck:
    from certkit.mechanics import simulate  # noqa: PLC0415  # a solver, only here

    flesh = setup.legform.flesh
    half = 0.5 * max(float(bone.depth) for bone in setup.legform.parts.values())
    face = half if flesh.face is None else float(flesh.face)
    forces = recorded_forces(run.result, run.data.motion, face=face, thickness=float(flesh.thickness))
    # Smoothing spreads the first force a little ahead of contact, and histories may hold noise.
    early = np.array(run.result.times) < run.start
    forces = [replace(force, force=np.where(early, 0.0, force.force)) for force in forces]
    done = simulate(setup.procedure, setup.legform, driven=forces)
    start, interval, _ = run.axis
    begun = run.result.start + done.run.contact
    return SelfCheck(
        id="leg alone",
        title=TITLES["leg alone"],
        start=start,
        interval=interval,
        until=run.until,
        channels=channel_checks(run.data, done, start=begun, until=run.until),
    )


def _coupled(run: CheckedRun, setup: Setup) -> tuple[SelfCheck, FrontMotion | None]:
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
    every = run.axis[2]
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
    run: CheckedRun, key: str, moved: Mapping[str, Values], forces: Mapping[str, Values] | None = None
) -> SelfCheck:
    """Compare the groups' movement, and the impulse and work on each where the forces are known."""
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
        within=None if worst is None else worst <= run.settings.movement_limit,
    )


def _judged(run: CheckedRun, groups: list[GroupCheck]) -> set[str]:
    """Return the faces that move."""
    faces = {group.name for group in run.result.groups if group.position is not None}
    most = max((g.run_peak for g in groups if g.name in faces), default=0.0)
    return {g.name for g in groups if g.name in faces and g.run_peak >= STILL * most}
