"""The self-checks of an extraction: front, leg and contact alone, and all together, beside their run.

The front alone, driven by the run's own contact forces, shows what the springs are worth. The leg alone,
driven by the same forces, shows what the leg is worth; the contact alone, with both led along the run's
motion, what their contact is worth. Only where all agree is an agreement of the coupled run a prediction and
no compensation.
"""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from msgspec.structs import replace

from certkit.bench.channel_checks import channel_checks, channel_remarks, percent_above
from certkit.bench.checked_run import CheckedRun
from certkit.bench.contact_check import contact_alone, leg_nodes
from certkit.bench.contact_places import recorded_forces
from certkit.bench.front_frames import front_motion
from certkit.bench.group_checks import contact_figures, group_checks
from certkit.bench.leg_remarks import flesh_pressed_twice
from certkit.bench.path_checks import path_checks
from certkit.bench.setup import prepare
from certkit.bench.tried_check import TITLES, tried
from certkit.documents.self_check import SelfCheck
from certkit.grading.front_limits import front_use
from certkit.grading.quality_gate import grade_quality
from certkit.grading.remarks import untrusted
from certkit.identification.vehicle_file import vehicle_text
from certkit.reporting.language import language

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.bench.setup import Setup
    from certkit.definitions.extraction_case import Case
    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.front_motion import FrontMotion
    from certkit.exchange.fe import FrontData


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
    procedure: str | Path,
    tell: Callable[[str], None],
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
    tell : callable
        Told what is being done.

    Returns
    -------
    HeldToRun
        The front alone; where the run tells what its leg did, also the leg alone and both; where it tells
        how the leg moved, also the contact alone. The leg flies as in the run, whatever the procedure says.

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
    beyond: list[str] = []
    checks.append(tried("leg alone", axis, run.until, lambda: _leg_alone(run, setup, beyond)))
    nodes = leg_nodes(data.motion)
    if nodes is not None:
        tell("self-check: the contact alone")
        checks.append(tried("contact alone", axis, run.until, lambda: contact_alone(run, setup, nodes)))
    tell("self-check: leg and front")
    motions: list[FrontMotion | None] = [None]

    def coupled() -> SelfCheck:
        check, motions[0], said = _coupled(run, setup)
        beyond.extend(said)
        return check

    checks.append(tried("coupled", axis, run.until, coupled))
    warnings, notes = run.flight_remarks(setup.procedure, setup.legform)
    twice = [] if setup.vehicle is None else flesh_pressed_twice(setup.vehicle)
    beyond += [language().sentence(reason) for reason in twice]
    return HeldToRun(tuple(checks), motions[0], (*warnings, *beyond), tuple(notes))


def _front_alone(run: CheckedRun, setup: Setup) -> SelfCheck:
    from certkit.mechanics.recorded_drive import drive_front  # noqa: PLC0415  # a solver, only here

    if setup.vehicle is None:
        raise ValueError("a front is checked with a procedure that hits a vehicle")
    forces = recorded_forces(run.result, None, face=0.0, thickness=1.0)
    driven = drive_front(setup.vehicle, forces, run.until - run.result.start)
    axis = driven.time + run.result.start
    moved = {name: np.interp(run.time, axis, x) for name, x in driven.displacement.items()}
    return group_checks(run, "front alone", moved)


def _leg_alone(run: CheckedRun, setup: Setup, remarks: list[str]) -> SelfCheck:
    """Return the check; add to the remarks what the run's own channels contradict."""
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
    if run.result.closed is not False:  # else the forces are not the run's
        remarks += channel_remarks(run.data, done, start=begun, until=run.until)
    return SelfCheck(
        id="leg alone",
        title=TITLES["leg alone"],
        start=start,
        interval=interval,
        until=run.until,
        channels=channel_checks(run.data, done, start=begun, until=run.until),
    )


def _coupled(run: CheckedRun, setup: Setup) -> tuple[SelfCheck, FrontMotion | None, list[str]]:
    """Return the check, its frames, and which limits of a run that can be trusted it left."""
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
    check = group_checks(run, "coupled", moved, forces)
    quality = grade_quality(done.quality, front=front_use(front, setup.vehicle))
    recording = done.recording
    force = np.interp(run.time, run.start + recording.time, recording["contact force"].values, left=0.0)
    impulse = float(force.sum() * (run.time[1] - run.time[0]))
    impactor = next(group for group in run.result.groups if group.kind == "impactor")
    left = impactor.momentum[run.time.size - 1]
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
            "rebound_percent": percent_above(impactor.momentum[0] - impulse, left) if left != 0 else None,
            "within": check.within and quality.verdict == "pass",
            **contact_figures(run, check.groups, force),
        }
    )
    sentence = language().sentence
    said = [sentence(untrusted(found)) for found in quality.checks if found.verdict != "pass"]
    return whole, motion, [f"{TITLES['coupled']}: {words}" for words in said]
