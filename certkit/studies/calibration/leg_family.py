"""The family: legs with other numbers that pass every graded criterion as well.

Walkers start at the fitted leg and step at random, with the steps shaped by what the tests leave open, and
never leave the region in which everything passes. The members are those places, of all that were visited,
that lie farthest apart.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import RunError, UsageError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.studies.calibration.fit import Calibration
    from certkit.studies.calibration.search import Tell
    from certkit.studies.points import Outcome
    from certkit.studies.runs import Runs

STRIDES = (0.15, 0.4, 1.0)
"""Lengths of the steps in turn, in standard deviations: short ones pass, long ones get about."""


def passes(outcome: Outcome, procedures: tuple[str, ...]) -> bool:
    """Tell whether a run passed everything that is graded, with numbers that can be trusted."""
    verdicts = [outcome.outputs.get(f"{name}/verdict") for name in procedures]
    return not outcome.error and all(verdict in {"pass", "not evaluated"} for verdict in verdicts)


def kin(calibration: Calibration, runs: Runs, count: int, tell: Tell) -> NDArray[np.float64]:
    """Find relatives of the fitted leg.

    Parameters
    ----------
    calibration : Calibration
        Its leg has to pass itself.
    runs : Runs
        Of the same task.
    count : int
        How many legs besides the fitted one.
    tell : callable
        Told how far the walk has come.

    Returns
    -------
    ndarray, shape (count, k)
        Shares.

    Raises
    ------
    RunError
        When the fitted leg does not pass, or too few others were found.
    UsageError
        When nothing of the legform may differ.
    """
    task, wanted = calibration.task, calibration.task.sheet.family
    procedures = task.trial.procedures
    if not passes(calibration.after, procedures):
        raise RunError(
            "the fitted leg does not pass every graded criterion itself: it has no certified family"
        )
    free = _free(calibration)
    root = np.linalg.cholesky(calibration.knowledge.covariance[np.ix_(free, free)])
    random = np.random.default_rng(wanted.seed)
    places = np.repeat(calibration.shares[None, :], wanted.walkers, axis=0)
    visited = [calibration.shares]
    for step in range(wanted.steps):
        stride = STRIDES[step % len(STRIDES)]
        tried = places.copy()
        tried[:, free] += stride * random.standard_normal((wanted.walkers, len(free))) @ root.T
        inside = ((tried[:, free] >= 0) & (tried[:, free] <= 1)).all(axis=1)
        outcomes = runs([task.space.point(row) for row in tried[inside]])
        good = np.flatnonzero(inside)[[passes(outcome, procedures) for outcome in outcomes]]
        places[good] = tried[good]
        visited += list(tried[good])
        tell(f"family: step {step + 1} of {wanted.steps}, {len(visited)} legs that pass")
    if len(visited) <= count:
        raise RunError(
            f"only {len(visited) - 1} other legs that pass were found, not {count}; "
            "raise the family's steps or walkers"
        )
    return _far_apart(np.array(visited), count)


def _free(calibration: Calibration) -> list[int]:
    """Return which axes may differ: those of the leg, or the ones that the fit names."""
    names = calibration.task.space.names
    wanted = calibration.task.sheet.family.vary
    strangers = sorted(set(wanted or ()) - set(names))
    if strangers:
        raise UsageError(f"family: `{strangers[0]}` is no parameter of this fit")
    free = [i for i, name in enumerate(names) if (name in wanted if wanted else name.startswith("legform."))]
    if not free or not all(names[i].startswith("legform.") for i in free):
        raise UsageError("family: only numbers of the legform can differ between its members")
    return free


def _far_apart(places: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Take again and again the place that is farthest from the first one and from all taken."""
    taken = [0]
    distance = np.linalg.norm(places - places[0], axis=1)
    while len(taken) <= count:
        taken.append(int(distance.argmax()))
        distance = np.minimum(distance, np.linalg.norm(places - places[taken[-1]], axis=1))
    chosen: NDArray[np.float64] = places[taken[1:]]
    return chosen
