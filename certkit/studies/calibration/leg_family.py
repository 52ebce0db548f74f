"""The family: legs with other numbers that pass every graded criterion as well.

Each member is a fit of its own. It begins at the fitted leg or at the bottom of another basin, is drawn to
another place of the whole parameter space, and aims at another place inside the corridors. Rig dimensions
that no text gives are as free as the leg's numbers. So members do not gather around the fitted leg: their
spread is that of legs which pass, as far as the bounds reach.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.definitions.loading.library import load
from certkit.errors import RunError
from certkit.studies.calibration.basins import spread_places
from certkit.studies.calibration.search import Misfit
from certkit.studies.quantity import number_in
from certkit.studies.trial import scoped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.studies.calibration.fit import Calibration
    from certkit.studies.calibration.search import Tell
    from certkit.studies.points import Outcome
    from certkit.studies.runs import Runs

TRIES = 4
"""Searches a member, at most: some end where not everything passes."""

PULL = 0.2
"""What half the width of a parameter's bounds weighs, as a distance of a goal in what counts as one."""

INSIDE = 0.02
"""Shares of the bounds that a member keeps from both: a number on its bound is the bound's."""

STRIDE = 0.3
"""Largest change of a parameter's share in one step."""


def passes(outcome: Outcome, procedures: tuple[str, ...]) -> bool | None:
    """Tell whether a run passed all that is graded, with numbers that can be trusted; None: nothing is."""
    verdicts = {outcome.outputs.get(f"{name}/verdict") for name in procedures}
    if outcome.error or not verdicts <= {"pass", "not evaluated"}:
        return False
    return True if "pass" in verdicts else None


def find_members(calibration: Calibration, runs: Runs, count: int, tell: Tell) -> NDArray[np.float64]:
    """Find legs that pass.

    A search that ends where a criterion fails, or where a run cannot be trusted, is dropped.

    Parameters
    ----------
    calibration : Calibration
        Its leg has to pass itself.
    runs : Runs
        Of the same task.
    count : int
        How many legs besides the fitted one.
    tell : callable
        Told how far the search has come.

    Returns
    -------
    ndarray, shape (count, k)
        Shares of the bounds, rig dimensions included.

    Raises
    ------
    RunError
        When the fitted leg does not pass, nothing is graded, or too few others were found.
    """
    task, wanted = calibration.task, calibration.task.sheet.family
    procedures = task.trial.procedures
    own = passes(calibration.after, procedures)
    if own is None:
        raise RunError(
            "none of the targets' procedures grades anything: there is no test that a family could pass"
            "; add one with corridors to the targets"
        )
    if not own:
        raise RunError(
            "the fitted leg does not pass every graded criterion itself: it has no certified family"
            "; widen the bounds, or free more parameters"
        )
    misfit = Misfit(runs, task.space, task.goals, pull=0.0)
    known = [] if wanted.starts is None else _places_of(calibration, wanted.starts)
    starts = [calibration.shares, *(basin.shares for basin in calibration.basins), *known]
    slopes = [misfit.forward_jacobian(start)[: len(task.goals)] for start in starts]
    places = spread_places(TRIES * count, len(task.space.axes), wanted.seed)
    aims = spread_places(TRIES * count, len(task.goals), wanted.seed + 1)
    members: list[NDArray[np.float64]] = []
    for number, (place, aim) in enumerate(zip(places, aims, strict=True)):
        which = number % len(starts)
        aimed = wanted.within * (2 * aim - 1)
        reached = _drawn(misfit, starts[which], slopes[which], place, aimed, wanted.steps)
        if passes(runs([task.space.point(reached)])[0], procedures):
            members.append(reached)
        tell(f"family: {len(members)} of {count} legs that pass, {number + 1} searches")
        if len(members) == count:
            return np.array(members)
    raise RunError(
        f"only {len(members)} legs that pass were found in {TRIES * count} searches, not {count}; "
        "raise the family's steps"
    )


def _places_of(calibration: Calibration, family: str) -> list[NDArray[np.float64]]:
    """Return the places of a family's members; a number that they leave alone is the fitted leg's."""
    task = calibration.task
    document = load("family", family, library=task.trial.library).document
    places = []
    for member in document.members:
        place = calibration.shares.copy()
        for i, axis in enumerate(task.space.axes):
            scope, path = scoped(axis.name)
            text = member.overrides(scope).get(path)
            if text is not None:
                place[i] = axis.share(number_in(text, axis.unit, axis.name))
        places.append(np.clip(place, INSIDE, 1 - INSIDE))
    return places


def _drawn(
    misfit: Misfit,
    start: NDArray[np.float64],
    slopes: NDArray[np.float64],
    place: NDArray[np.float64],
    aims: NDArray[np.float64],
    steps: int,
) -> NDArray[np.float64]:
    """Walk from `start` towards `place` with all goals kept at their aims, as far as both go together.

    Gauss-Newton on the goals and the pull to the place, from the derivatives at the start, which each step
    corrects by what it found (Broyden's update); a step that makes things worse is halved.
    """
    weight = 2 * PULL

    def residuals(shares: NDArray[np.float64]) -> NDArray[np.float64]:
        goals = misfit.one(shares)[: len(aims)] - aims
        return np.concatenate([goals, weight * (shares - place)])

    shares, now = start, residuals(start)
    jacobian = np.vstack([slopes, weight * np.eye(len(start))])
    reach = 1.0
    for _ in range(steps):
        step = np.linalg.lstsq(jacobian, -now, rcond=None)[0]
        step = np.clip(reach * step, -STRIDE, STRIDE)
        tried = np.clip(shares + step, INSIDE, 1 - INSIDE)
        moved = tried - shares
        if np.abs(moved).max() < INSIDE / 10:
            break
        after = residuals(tried)
        jacobian += np.outer(after - now - jacobian @ moved, moved) / float(moved @ moved)
        if after @ after < now @ now:
            shares, now, reach = tried, after, min(2 * reach, 1.0)
        else:
            reach /= 2
    return shares


class FamilyExtent(Struct, frozen=True):
    """How much of what the bounds allow a family covers.

    Parameters
    ----------
    coverage : float
        Range of each parameter over its bounds, averaged.
    evenness : float
        Standard deviation of each parameter over that of a uniform one between the bounds, averaged.
    dimensions : float
        Directions in which the members differ: participation ratio (Σλ)² / Σλ² of their covariance.
    distance : float
        Mean distance of a member from the nearest other, over that of as many places spread evenly.
    """

    coverage: float
    evenness: float
    dimensions: float
    distance: float


def extent(members: NDArray[np.float64]) -> FamilyExtent:
    """Measure a family of at least two members, shape (n, k) in shares of the bounds."""
    spread = np.linalg.eigvalsh(np.cov(members, rowvar=False))
    even = spread_places(len(members), members.shape[1], seed=0)
    return FamilyExtent(
        coverage=float(np.ptp(members, axis=0).mean()),
        evenness=float(np.std(members, axis=0, ddof=1).mean() * np.sqrt(12)),
        dimensions=float(spread.sum() ** 2 / np.sum(spread**2)),
        distance=_nearest(members) / _nearest(even),
    )


def _nearest(places: NDArray[np.float64]) -> float:
    """Return the mean distance of a place from the nearest other."""
    apart = np.linalg.norm(places[:, None, :] - places[None, :, :], axis=2)
    np.fill_diagonal(apart, np.inf)
    return float(apart.min(axis=1).mean())
