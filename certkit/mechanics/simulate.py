"""`simulate`: a procedure's rig, with a legform on it, run in time."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.errors import RunError
from certkit.files.limits import MAX_KEPT_SAMPLES
from certkit.mechanics.legform.leg import add_leg
from certkit.mechanics.legform.segments import leg_segments
from certkit.mechanics.legform.stable_step import stable_step
from certkit.mechanics.outputs.energy_balance import RunQuality, energy_histories, run_quality
from certkit.mechanics.outputs.front_response import front_response
from certkit.mechanics.outputs.motion import recorded_motion
from certkit.mechanics.outputs.recorded_channels import channels, probes
from certkit.mechanics.rig.rig_assembly import RigAssembly
from certkit.mechanics.solver.pymunk_space import ITERATIONS
from certkit.mechanics.solver.time_loop import Plan, Trajectory, run_world
from certkit.mechanics.solver.world import Assembly
from certkit.signals import Recording

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure
    from certkit.definitions.vehicle import Vehicle
    from certkit.documents.result import Front, Histories
    from certkit.documents.rig_motion import Motion
    from certkit.mechanics.legform.segments import Segment
    from certkit.mechanics.records import Floats
    from certkit.mechanics.rig.recorded_forces import RecordedForce

STEP = 2e-5
"""s: step halving changes no peak by more than 0.1 % at it."""
REST_STEP = 4e-5
"""s, where only states at rest count: they are the same at any step that is stable."""
UNTIL = 0.2
"""s after contact, where a procedure names no end."""
TAIL = 0.002
"""s recorded beyond the evaluated window, so that the window and not the record's end ends the search."""
FRAME = 1e-3
"""s between two frames of the motion."""


class Simulation(Struct, frozen=True, dict=True):
    """What a simulated test yields.

    Parameters
    ----------
    recording : Recording
        Channels from first contact; of a static test one sample a load level.
    quality : RunQuality
    solver_seconds : float
        Of the time loop.
    rig, run, readings, samples_a_frame
        What the documents' parts below are made of, when they are asked for.
    """

    recording: Recording
    quality: RunQuality
    solver_seconds: float
    rig: RigAssembly
    run: Trajectory
    readings: Mapping[str, Floats]
    samples_a_frame: int

    @cached_property
    def motion(self) -> Motion:
        """Return the motion of leg and rig."""
        at = np.arange(len(self.run.frame_time), dtype=np.int64) * self.samples_a_frame
        return recorded_motion(self.rig, self.run, self.readings, at)

    @cached_property
    def energies(self) -> Histories | None:
        """Return the energies over time; None for static tests, whose clock means nothing."""
        return energy_histories(self.quality, self.recording)

    @cached_property
    def front(self) -> Front | None:
        """Return what the vehicle's front did, None where none was hit."""
        return front_response(self.rig, self.run, self.readings)


def build(
    procedure: Procedure,
    legform: Legform,
    vehicle: Vehicle | None = None,
    driven: Sequence[RecordedForce] = (),
) -> RigAssembly:
    """Put the legform on the procedure's rig; `rig.assembly.finish()` is the world to run."""
    specimen = procedure.specimen
    fixtures = procedure.rig.fixtures()
    segments: Sequence[Segment] = leg_segments(legform, specimen.part)
    for fixture in fixtures:
        segments = fixture.change_segments(segments)
    flesh = specimen.flesh == "fitted"
    assembly = Assembly()
    damping = max((fixture.mass_damping(segments) for fixture in fixtures), default=0.0)
    leg = add_leg(assembly, legform, segments, flesh=flesh, damping=damping)
    cover = float(legform.flesh.thickness) if flesh else 0.0
    rig = RigAssembly(
        assembly=assembly,
        legform=legform,
        rig=procedure.rig,
        leg=leg,
        cover=cover,
        vehicle=vehicle,
        driven=driven,
    )
    for fixture in fixtures:
        fixture.build(rig)
    rig.add_outline()
    return rig


def simulate(
    procedure: Procedure,
    legform: Legform,
    *,
    vehicle: Vehicle | None = None,
    driven: Sequence[RecordedForce] = (),
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
    driven : sequence of RecordedForce
        Contact forces that press on the leg in free flight in the vehicle's place.
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
        rig = build(procedure, legform, vehicle, driven)
    except (ArithmeticError, np.linalg.LinAlgError) as error:
        raise RunError(
            "the rig cannot be built: a length, stiffness or other value is zero where it cannot be; "
            "look at the values changed last"
        ) from error
    step = time_step or _time_step(procedure, rig)
    world = rig.assembly.finish()
    wanted = probes(world, rig)
    plan = _plan(procedure, rig, step, iterations, sample)
    groups = () if rig.front is None else rig.front.groups.values()
    tracked = (*(rig.leg.blocks if rig.leg.knee_row >= 0 else ()), *groups)
    run = run_world(world, plan, list(wanted.values()), tracked)
    readings = {name: run.readings[:, i] for i, name in enumerate(wanted)}
    recording = Recording(
        kind="simulated",
        time=run.time,
        channels=channels(rig, run, readings),
        source=procedure.procedure,
        table=legform.channel_table,
        from_solver=True,
    )
    return Simulation(
        recording=_from_contact(recording, run),
        quality=run_quality(run, step, iterations),
        solver_seconds=run.seconds,
        rig=rig,
        run=run,
        readings=readings,
        samples_a_frame=plan.frame // plan.sample,
    )


def _time_step(procedure: Procedure, rig: RigAssembly) -> float:
    if procedure.run.time_step is not None:
        return float(procedure.run.time_step)
    wanted = REST_STEP if rig.load_levels > 0 else STEP
    return stable_step(wanted, rig.legform, rig.leg.segments, flesh=rig.cover > 0)


def _plan(procedure: Procedure, rig: RigAssembly, step: float, iterations: int, sample: int | None) -> Plan:
    """Plan one sample a load level, or from first contact to the procedure's end."""
    if rig.load_levels > 0:
        level = round(rig.level_duration / step)
        return Plan(step, rig.load_levels * level * step, 0.0, level, level, None, iterations)
    if rig.longest_approach > 0 and rig.contact_law is None:
        raise RunError("the legform moves, but nothing is there for it to hit; add a fixture that it hits")
    until = float(procedure.run.until or UNTIL)
    if until > 10 * TAIL:
        until += TAIL
    sample = sample or max(1, round(2 * STEP / step))
    if until / (step * sample) > MAX_KEPT_SAMPLES:
        raise RunError(
            f"a run of {until:g} s with a sample every {step * sample:g} s is more than a document can hold; "
            f"at most {MAX_KEPT_SAMPLES:,} samples are kept: give `until` less"
        )
    frame = max(1, round(FRAME / (step * sample))) * sample
    return Plan(step, until, rig.longest_approach + until, sample, frame, rig.contact_law, iterations)


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
