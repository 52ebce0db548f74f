"""`calibrate`: carry out a fit document."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.definitions.calibration import CalibrationTask
from certkit.definitions.loading.library import load
from certkit.errors import RunError
from certkit.studies.calibration.basins import Basin, basin_at, find_basins
from certkit.studies.calibration.identifiability import Knowledge, knowledge
from certkit.studies.calibration.parameter_space import Space, space_of
from certkit.studies.calibration.recorded_targets import recorded_curves, recorded_goals
from certkit.studies.calibration.search import Misfit, downhill, everywhere
from certkit.studies.calibration.targets import Goal, distances, goals_of
from certkit.studies.check_runs import check_runs
from certkit.studies.runs import Runs
from certkit.studies.trial import Trial

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from certkit.documents.calibration_report import CalibrationReport
    from certkit.studies.calibration.search import Tell
    from certkit.studies.execution import Execution
    from certkit.studies.points import Outcome


NEARER = 0.01
"""Share of the sum of squares by which another place has to be better to be called nearer."""


class Task(Struct, frozen=True):
    """A fit made ready: what is run, what is free, what is aimed at."""

    sheet: CalibrationTask
    trial: Trial
    space: Space
    goals: tuple[Goal, ...]


class Calibration(Struct, frozen=True):
    """What a fit came to.

    Parameters
    ----------
    task : Task
    shares : ndarray, shape (k,)
        The best place found, as shares of the bounds.
    before, after : Outcome
        Of the start and of the best place.
    knowledge : Knowledge
    runs : int
        Distinct runs that the fit needed.
    basins : tuple of Basin
        Other places that searches came to, the best first. With `start: anywhere` the best of all is taken;
        else they show what else the tests allow.
    left_out : dict of str to float
        What each value came to in a fit without it, where that was wanted.
    nearer : bool
        Whether another search came nearer than this fit.
    report : CalibrationReport, optional
        Its document, where it was written.
    files : tuple of Path
        What was written of it.
    """

    task: Task
    shares: NDArray[np.float64]
    before: Outcome
    after: Outcome
    knowledge: Knowledge
    runs: int
    basins: tuple[Basin, ...]
    left_out: dict[str, float | str | None]
    nearer: bool = False
    report: CalibrationReport | None = None
    files: tuple[Path, ...] = ()

    @property
    def point(self) -> dict[str, float]:
        """The fitted numbers, in their units."""
        return self.task.space.point(self.shares)

    def rms(self, outcome: Outcome) -> float:
        """Return the root mean square distance of all goals, in what counts as one."""
        return float(np.sqrt(np.mean(np.square(distances(self.task.goals, outcome)))))


def fit_sheet(document: CalibrationTask | str | Path, library: Sequence[Path] = ()) -> CalibrationTask:
    """Return the fit that is given, named or in a file."""
    return load("fit", document, library=library).document if isinstance(document, (str, Path)) else document


def make_ready(document: CalibrationTask | str | Path, library: Sequence[Path] = ()) -> Task:
    """Load everything a fit needs and check that it fits together.

    Parameters
    ----------
    document : CalibrationTask, str or Path
        A fit that is named by its file finds definitions, recordings and mappings beside it.
    library : sequence of Path
        Folders with own definitions, searched first.

    Raises
    ------
    UsageError, DefinitionError
        Before anything is run.
    """
    sheet = fit_sheet(document, library)
    folder = Path() if isinstance(document, CalibrationTask) else Path(document).parent
    if folder != Path():
        library = (*library, folder)
    procedures = tuple(dict.fromkeys(target.procedure for target in sheet.targets))
    trial = Trial(
        procedures,
        tied={
            p.name: (*((path, 1.0) for path in p.with_), *((path, -1.0) for path in p.opposite))
            for p in sheet.parameters
            if p.with_ or p.opposite
        },
        fixed={"legform": sheet.legform},
        library=tuple(str(Path(folder)) for folder in library),
    )
    looked_for = sheet.search
    check_runs(looked_for.population * (looked_for.generations + 1), len(sheet.parameters), "global search")
    space = space_of(sheet.parameters, trial.nominals(p.name for p in sheet.parameters))
    curves = recorded_curves([target for target in sheet.targets if target.to == "recording"], folder)
    trial = replace(trial, units={axis.name: axis.unit for axis in space.axes}, curves=tuple(curves.values()))
    start = space.point(space.start)
    goals: list[Goal] = []
    for target in sheet.targets:
        if target.to == "recording":
            goals += recorded_goals(target, curves)
        else:
            goals += goals_of(target, trial.prepared(target.procedure, start))
    return Task(sheet, trial, space, tuple(goals))


def runs_for(task: Task, execution: Execution) -> Runs:
    """Open the runs of a fit; what an interrupted one has done is found again in the journal."""
    return Runs(task.trial, execution, context=task.trial.context)


def calibrate(task: Task, runs: Runs, tell: Tell = lambda _: None) -> Calibration:
    """Find the best numbers and say how well they are known.

    Parameters
    ----------
    task : Task
        From `make_ready`.
    runs : Runs
        From `runs_for`.
    tell : callable
        Told how far the search has come.

    Raises
    ------
    RunError
        When not even the best place found can be run.
    """
    search = task.sheet.search
    misfit = Misfit(runs, task.space, task.goals, search.pull)
    best = downhill(misfit, everywhere(misfit, search, tell), search.steps, tell)
    basins = find_basins(misfit, search, tell) if search.basins else []
    own = basin_at(misfit, "first", best)
    nearest = min([own, *basins], key=lambda basin: basin.squares)
    if search.start == "anywhere":
        own, best = nearest, nearest.shares
    before, after = runs([task.space.point(task.space.start), task.space.point(best)])
    if after.error:
        raise RunError(f"the best place found cannot be run ({after.error}); narrow the bounds")
    missing = [goal.name for goal in task.goals if not isinstance(after.outputs.get(goal.name), float)]
    if missing:
        raise RunError(f"the best place found gives no value of {missing[0]}; leave it out of the targets")
    slopes = misfit.jacobian(best)[: len(task.goals)]
    left_out = _left_out(misfit, best, search.steps, tell) if search.leave_one_out else {}
    known = knowledge(task.space, best, slopes)
    nearer = nearest.squares < (1 - NEARER) * own.squares
    return Calibration(task, best, before, after, known, runs.known, tuple(basins), left_out, nearer=nearer)


def _left_out(
    misfit: Misfit, best: NDArray[np.float64], steps: int, tell: Tell
) -> dict[str, float | str | None]:
    """Fit without each value in turn, from the best place; return what the value came to there."""
    found = {}
    for left in misfit.goals:
        others = [goal for goal in misfit.goals if goal is not left]
        shares = downhill(Misfit(misfit.runs, misfit.space, others, misfit.pull), best, steps, tell)
        found[left.name] = misfit.runs([misfit.space.point(shares)])[0].outputs.get(left.name)
    return found
