"""`run`: simulate a procedure, look at what the time step costs, grade."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.bench.leg_remarks import leg_remarks
from certkit.bench.model_origins import fits_of, fitted_to, model_remarks
from certkit.bench.setup import Setup, prepare
from certkit.documents.rounding import rounded_difference
from certkit.grading import (
    SimulatedTerms,
    criterion_values,
    evaluate,
    grade_quality,
    largest_step_change,
    measure_all,
    numerical_uncertainties,
)
from certkit.grading.asked_criterion import dimension_of
from certkit.grading.front_limits import front_use
from certkit.reasons import Reason
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Future
    from pathlib import Path

    from certkit.definitions.loading.library import Library
    from certkit.definitions.loading.overrides import Overrides
    from certkit.documents.result import Result
    from certkit.grading import Measurements, StepChange
    from certkit.mechanics import Simulation

SMALLEST = {"N·m": 20.0, "mm": 1.5, "N": 200.0}
"""Five percent of the channels' amplitude classes (400 N·m, 30 mm, 4 kN): a change of a smaller peak is taken
relative to this. No corridor begins below 3.5 mm or 90 N·m, so such a peak decides nothing."""


class Refinement(Struct, frozen=True):
    """What finer runs say of the reported one: largest change, and numerical uncertainty by criterion."""

    step_change: StepChange
    uncertainties: dict[str, float]


def run(
    procedure: str | Path,
    *,
    library: Library = (),
    overrides: Overrides | None = None,
    refine: bool = True,
) -> Result:
    """Simulate a procedure and grade it: a virtual certification of the model.

    Parameters
    ----------
    procedure : str or Path
        Name that the library knows, or a file.
    library : str, Path, or sequence of them
        Folders with own definitions, searched first.
    overrides : mapping, optional
        Values to change by their paths, `{"rig.release.angle": "16 deg"}`; see `certkit.bench.setup.prepare`.
    refine : bool
        Run again with half the time step and with more iterations, to know what they cost. Without it the
        quality of the result has no `step_change_percent`.

    Raises
    ------
    DefinitionError, UsageError
        When a definition cannot be used.
    RunError
        When the simulation does not finish.
    """
    return run_setup(prepare(procedure, library=library, overrides=overrides), refine=refine, library=library)


def run_setup(setup: Setup, *, refine: bool = True, library: Library = ()) -> Result:
    """Simulate and grade what `prepare` has loaded; see `run`."""
    simulation = _simulate(setup)
    half = _begin_half_step(setup, simulation) if refine else None
    measured = measure_all(setup.procedure, simulation.recording)
    front, vehicle = simulation.front, setup.vehicle
    fits = fits_of(setup, library)
    fitted = tuple(fitted_to(setup, fits, library))
    bounds = (*model_remarks(setup, fits, front), *leg_remarks(setup, simulation))
    refinement = _refine(setup, simulation, measured, half.result) if half else None
    quality = grade_quality(
        simulation.quality,
        step_change=refinement.step_change if refinement else None,
        solver_seconds=simulation.solver_seconds,
        front=None if front is None or vehicle is None else front_use(front, vehicle),
    )
    simulated = SimulatedTerms(
        fitted=fitted,
        bounds=bounds,
        quality=quality,
        numerical=refinement.uncertainties if refinement else {},
        legform=setup.legform.title,
        motion=simulation.motion,
        energies=simulation.energies,
        front=simulation.front,
    )
    notes = [Reason.words(text) for text in setup.remarks]
    return worded(evaluate(measured, setup.terms(), simulated=simulated, notes=notes))


def _simulate(setup: Setup, *, time_step: float | None = None, iterations: int | None = None) -> Simulation:
    from certkit.mechanics import simulate  # noqa: PLC0415  # a measured test is graded without the solver

    return simulate(
        setup.procedure, setup.legform, vehicle=setup.vehicle, time_step=time_step, iterations=iterations
    )


def _begin_half_step(setup: Setup, reported: Simulation) -> Future[Simulation]:
    """Begin a run at half the step, beside the one with more iterations and what else there is to do.

    The solver lets other threads run meanwhile: on two cores a person waits for one run less.
    """
    from concurrent.futures import ThreadPoolExecutor  # noqa: PLC0415  # a measured test needs none

    beside = ThreadPoolExecutor(1)
    begun = beside.submit(_simulate, setup, time_step=reported.quality.time_step / 2)
    beside.shutdown(wait=False)
    return begun


def _refine(
    setup: Setup, reported: Simulation, measured: Measurements, half_step: Callable[[], Simulation]
) -> Refinement:
    """Compare with a run at half the step and one with twice the solver iterations.

    The numerical uncertainty of a criterion is the grid convergence index of the step plus the change that
    the iterations make: two causes that have nothing to do with each other, added without hoping that they
    cancel.
    """
    patient = _simulate(setup, iterations=2 * reported.quality.iterations)
    half = half_step()
    values = criterion_values(measured)
    halved = criterion_values(measure_all(setup.procedure, half.recording))
    iterated = criterion_values(measure_all(setup.procedure, patient.recording))
    by_step = numerical_uncertainties(values, halved)
    uncertainties = {
        name: rounded_difference(by_step[name] + abs(after - before), of=before)
        for name, before in values.items()
        if name in by_step and before is not None and (after := iterated.get(name)) is not None
    }
    decisive = _decisive(setup)
    change = largest_step_change(
        {name: value for name, value in values.items() if name in decisive}, halved, _floors(setup)
    )
    return Refinement(change, uncertainties)


def _decisive(setup: Setup) -> set[str]:
    """Return the criteria that the result rests on: graded ones, else those compared, else all."""
    criteria = setup.procedure.criteria
    graded = {criterion.id for criterion in criteria if criterion.corridor is not None}
    compared = set(setup.reference.values) if setup.reference is not None else set()
    return graded or compared or {criterion.id for criterion in criteria}


def _floors(setup: Setup) -> dict[str, float]:
    channels = setup.legform.channel_table
    kinds = {criterion.id: dimension_of(criterion, channels) for criterion in setup.procedure.criteria}
    return {name: SMALLEST.get(kind.unit, 0.0) if kind else 0.0 for name, kind in kinds.items()}
