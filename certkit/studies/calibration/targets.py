"""What a fit aims at: each value as its distance from where it should be, in what counts as one."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.definitions.units import split_quantity
from certkit.errors import UsageError
from certkit.grading.asked_criterion import asked_criterion
from certkit.studies.quantity import share

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from certkit.bench.setup import Setup
    from certkit.definitions.calibration import Target
    from certkit.definitions.procedure import Criterion
    from certkit.studies.calibration.parameter_space import Space
    from certkit.studies.points import Outcome, Point

FAILED = 1000.0
"""Distance of every value of a run that failed: farther than any value, and no gradient leads there."""

FAR = 20.0
"""From here on a distance counts by its logarithm: one value far out does not outweigh all others, and the
search still sees which way it comes nearer."""

WITHIN = 3**-0.5
"""Standard deviation of a value that may lie anywhere in its corridor, in half-widths."""

FLAT = 12**-0.5
"""Standard deviation of a share of which only the bounds are known."""


class Goal(Struct, frozen=True):
    """One value and where it should be.

    Parameters
    ----------
    name : str
        Its output: `PROCEDURE/CRITERION`.
    aim, scale : float
        In the output's unit: where it should be and what counts as a distance of one.
    unit : str
    weight : float
        Multiplies the distance.
    graded : bool
        Whether a corridor decides on it.
    curve : str
        Name of the recorded curve that it is a place of; empty for a value of its own.
    """

    name: str
    aim: float
    scale: float
    unit: str
    weight: float
    graded: bool
    curve: str = ""

    def distance(self, value: float | str | None) -> float:
        """Return the distance without its weight; far for a value that is missing."""
        return (value - self.aim) / self.scale if isinstance(value, float) else FAILED


def distances(goals: Sequence[Goal], outcome: Outcome) -> NDArray[np.float64]:
    """Return the distance of each value, and of each curve as the root mean square over its places.

    In units of each goal's `scale`, shape (values and curves,).
    """
    groups: dict[str, list[float]] = {}
    for goal in goals:
        groups.setdefault(goal.curve or goal.name, []).append(goal.distance(outcome.outputs.get(goal.name)))
    return np.array([np.sqrt(np.mean(np.square(group))) for group in groups.values()])


def goals_of(target: Target, setup: Setup) -> list[Goal]:
    """Return the goals of one target.

    Raises
    ------
    UsageError
        When a criterion has no two-sided corridor or no reference value, or nothing is left to aim at.
    """
    find = _corridor_goal if target.to == "corridors" else _reference_goal
    known = {criterion.id: criterion for criterion in setup.procedure.criteria}
    strangers = sorted(set(target.criteria or ()) - set(known))
    if strangers:
        raise UsageError(f"{target.procedure} has no criterion `{strangers[0]}`; it has {', '.join(known)}")
    goals = []
    for identity in target.criteria or known:
        goal = find(known[identity], target, setup)
        if goal is not None:
            goals.append(goal)
        elif target.criteria:
            raise UsageError(
                f"{target.procedure}/{identity}: nothing says where it should be"
                "; give it a value, or a corridor"
            )
    if not goals:
        raise UsageError(f"{target.procedure}: none of its values has a place where it should be")
    return goals


def _corridor_goal(criterion: Criterion, target: Target, setup: Setup) -> Goal | None:
    asked = asked_criterion(criterion, setup.corridors, setup.legform.channel_table)
    if asked.lower is None or asked.upper is None:
        return None
    name = f"{target.procedure}/{criterion.id}"
    middle, half = (asked.lower + asked.upper) / 2, (asked.upper - asked.lower) / 2
    return Goal(name, middle, half, asked.unit, target.weight, graded=True)


def _reference_goal(criterion: Criterion, target: Target, setup: Setup) -> Goal | None:
    if setup.reference is None or criterion.id not in setup.reference.values:
        return None
    quantity = split_quantity(str(setup.reference.values[criterion.id]))
    part = share(target.tolerance)
    if quantity is None or part is None:
        raise UsageError(f"{target.procedure}: the tolerance has to be a share such as `5 %`")
    name = f"{target.procedure}/{criterion.id}"
    if not part * quantity[0]:
        raise UsageError(
            f"{name}: {target.tolerance} of {quantity[0]:g} is nothing; leave it out of `criteria`"
        )
    return Goal(name, quantity[0], part * abs(quantity[0]), quantity[1], target.weight, graded=False)


def residuals(
    goals: Sequence[Goal], space: Space, point: Point, outcome: Outcome, pull: float
) -> NDArray[np.float64]:
    """Return the weighted distances of all goals, then of all parameters from where they would rather be.

    The sum of their squares is what the fit makes small. A parameter with a prior is drawn to its mean, any
    other to the middle of its bounds with the strength `pull`: 1 is as much as bounds really tell, less
    lets the tests decide and still makes the answer unique. Shape (goals + parameters,), without unit.
    """
    values = [goal.weight * goal.distance(outcome.outputs.get(goal.name)) for goal in goals]
    pulls = [
        WITHIN * (float(point[axis.name]) - axis.prior[0]) / axis.prior[1]
        if axis.prior is not None
        else pull * WITHIN * (axis.share(float(point[axis.name])) - 0.5) / FLAT
        for axis in space.axes
    ]
    return _eased(np.array([*values, *pulls]))


def _eased(distances: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return distances that grow by their logarithm from `FAR` to `FAILED`, and no more beyond."""
    beyond = np.clip(np.abs(distances), FAR, FAILED)
    far: NDArray[np.float64] = np.sign(distances) * FAR * (1 + np.log(beyond / FAR))
    return np.where(np.abs(distances) > FAR, far, distances)
