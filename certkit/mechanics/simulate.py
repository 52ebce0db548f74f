"""`simulate`: a procedure's rig, with a legform on it, run in time."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from certkit.errors import RunError
from certkit.mechanics.fixtures.added_mass import with_added_mass
from certkit.mechanics.fixtures.hinge_and_hanger import fit_hanger, fit_hinge
from certkit.mechanics.fixtures.honeycomb_ram import fit_ram
from certkit.mechanics.fixtures.release import fit_release
from certkit.mechanics.fixtures.rig_assembly import Site
from certkit.mechanics.fixtures.stopper import fit_stopper
from certkit.mechanics.fixtures.three_point_bending import DRAG, HOLD, RAMP, fit_loading_ram, fit_supports
from certkit.mechanics.fixtures.vehicle_front import fit_front
from certkit.mechanics.legform.leg import add_leg
from certkit.mechanics.legform.segments import leg_segments
from certkit.mechanics.legform.stable_step import stable_step
from certkit.mechanics.outputs.energy_balance import RunQuality, judge
from certkit.mechanics.outputs.front_response import FrontHistories, front_histories, front_probes
from certkit.mechanics.outputs.motion import RecordedMotion, film
from certkit.mechanics.outputs.recorded_channels import channels, probes
from certkit.mechanics.solver.pymunk_space import ITERATIONS
from certkit.mechanics.solver.time_loop import Plan, Trajectory, run_world
from certkit.mechanics.solver.world import Assembly
from certkit.signals import Recording

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure
    from certkit.definitions.vehicle import Vehicle

STEP = 2e-5
"""s: step halving changes no peak by more than 0.1 % at it."""
UNTIL = 0.2
"""s after contact, where a procedure names no end."""
FRAME = 1e-3

FITTINGS: tuple[tuple[str, Callable[[Site, Any], None]], ...] = (
    ("hinge", fit_hinge),
    ("hanger", fit_hanger),
    ("release", fit_release),
    ("stopper", fit_stopper),
    ("ram", fit_ram),
    ("supports", fit_supports),
    ("loading_ram", fit_loading_ram),
)
"""What builds each fixture of a `certkit.definitions.rig.Rig`, in the order in which they are built."""


@dataclass(frozen=True)
class Simulation:
    """What a simulated test yields.

    Parameters
    ----------
    recording : Recording
        Channels from first contact; of a static test one sample a load level.
    motion : Motion
    quality : Quality
    solver_seconds : float
        Of the time loop.
    front : FrontHistories, optional
        What the vehicle's front did, where one was hit.
    """

    recording: Recording
    motion: RecordedMotion
    quality: RunQuality
    solver_seconds: float
    front: FrontHistories | None = None


def build(procedure: Procedure, legform: Legform, vehicle: Vehicle | None = None) -> Site:
    """Put the legform on the procedure's rig; `site.assembly.finish()` is the world to run."""
    rig, specimen = procedure.rig, procedure.specimen
    static = rig.loading_ram is not None
    segments = leg_segments(legform, specimen.part)
    if rig.added_mass is not None:
        segments = with_added_mass(segments, rig.added_mass)
    flesh = specimen.flesh == "fitted"
    assembly = Assembly()
    leg = add_leg(assembly, legform, segments, flesh=flesh, damping=DRAG if static else 0.0)
    site = Site(assembly, legform, rig, leg, cover=float(legform.flesh.thickness) if flesh else 0.0)
    for name, fit in FITTINGS:
        fixture = getattr(rig, name)
        if fixture is not None:
            fit(site, fixture)
    if rig.free_flight is not None:
        if vehicle is None:
            raise RunError("free flight hits a vehicle; name one in the procedure")
        fit_front(site, vehicle, rig.free_flight)
    site.draw_outline()
    return site


def simulate(
    procedure: Procedure,
    legform: Legform,
    *,
    vehicle: Vehicle | None = None,
    time_step: float | None = None,
    iterations: int | None = None,
    sample: int | None = None,
) -> Simulation:
    """Simulate a test.

    Parameters
    ----------
    procedure : Procedure
    legform : Legform
    vehicle : Vehicle, optional
        What is hit in free flight.
    time_step : float, optional
        Seconds; the procedure's own, else 2e-5 or the part of it that damping allows, when not given.
        Halve it to see what it costs.
    iterations : int, optional
        Of the constraint solver, 8 when not given.
    sample : int, optional
        Steps a sample; such that samples are about 4e-5 s apart when not given. Static tests have one
        sample a level.

    Raises
    ------
    RunError
        When the rig cannot be built, a body runs away or nothing is touched.
    """
    iterations = iterations or ITERATIONS
    try:
        site = build(procedure, legform, vehicle)
    except (ArithmeticError, np.linalg.LinAlgError) as error:
        raise RunError(
            "the rig cannot be built: a length, stiffness or other value is zero where it cannot be; "
            "look at the values changed last"
        ) from error
    step = time_step or _time_step(procedure, site)
    world = site.assembly.finish()
    wanted = {**probes(world, site.leg, site), **front_probes(world, site)}
    plan = _plan(procedure, site, step, iterations, sample)
    tracked = (*(site.leg.blocks if site.leg.knee_row >= 0 else ()), *site.front.values())
    run = run_world(world, plan, list(wanted.values()), tracked)
    readings = {name: run.readings[:, i] for i, name in enumerate(wanted)}
    every = plan.frame // plan.sample
    motion = film(site, site.leg, run, readings, np.arange(len(run.frame_time), dtype=np.int64) * every)
    quality = judge(run, step, iterations)
    recording = Recording(
        kind="simulated",
        time=run.time,
        channels=channels(site, site.leg, run, readings),
        source=procedure.procedure,
    )
    front = front_histories(site, run, readings)
    return Simulation(_from_contact(recording, run), motion, quality, run.seconds, front)


def _time_step(procedure: Procedure, site: Site) -> float:
    if procedure.run.time_step is not None:
        return float(procedure.run.time_step)
    return stable_step(STEP, site.legform, site.leg.segments, flesh=site.cover > 0)


def _plan(procedure: Procedure, site: Site, step: float, iterations: int, sample: int | None) -> Plan:
    ram = site.rig.loading_ram
    if ram is not None:
        level = round((RAMP + HOLD) / step)
        return Plan(step, ram.levels * level * step, 0.0, level, level, None, iterations)
    until = float(procedure.run.until or UNTIL)
    sample = sample or max(1, round(2 * STEP / step))
    frame = max(1, round(FRAME / (step * sample))) * sample
    return Plan(step, until, site.longest + until, sample, frame, site.trigger, iterations)


def _from_contact(recording: Recording, run: Trajectory) -> Recording:
    """Cut off what was before first contact and set time zero there."""
    first = int(np.searchsorted(recording.time, run.contact - 1e-12))
    if first == 0:
        return recording
    return replace(
        recording,
        time=recording.time[first:] - recording.time[first],
        channels={
            name: replace(channel, values=channel.values[first:])
            for name, channel in recording.channels.items()
        },
    )
