"""The search of a fit: everywhere first (differential evolution), then downhill (least squares).

Both ask for batches of points, so all processes have work, and both walk the same way again when they are
started again, so that the journal of runs is all that an interrupted fit needs.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from certkit.studies.calibration.targets import residuals

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from certkit.definitions.calibration import Search
    from certkit.studies.calibration.parameter_space import Space
    from certkit.studies.calibration.targets import Goal
    from certkit.studies.runs import Runs

    Tell = Callable[[str], None]
    """Called with a sentence on how far the search has come."""

STEP = 5e-3
"""Share of a parameter's range by which it is moved to see what it does."""

CLOUD = 0.1
"""Standard deviation, in shares, of the first population around the start."""


class Misfit:
    """Residuals of many points at once."""

    def __init__(self, runs: Runs, space: Space, goals: Sequence[Goal], pull: float) -> None:
        """Keep where points are run and what their values should be."""
        self.runs, self.space, self.goals, self.pull = runs, space, goals, pull

    def many(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the residuals, shape (n, m), at shares, shape (n, k)."""
        points = [self.space.point(row) for row in shares]
        outcomes = self.runs(points)
        return np.array(
            [
                residuals(self.goals, self.space, point, outcome, self.pull)
                for point, outcome in zip(points, outcomes, strict=True)
            ]
        )

    def one(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the residuals, shape (m,), at shares, shape (k,)."""
        row: NDArray[np.float64] = self.many(shares[None, :])[0]
        return row

    def had(self, shares: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Tell which residuals, shape (n, m), come from a value that its run gave."""
        outcomes = self.runs([self.space.point(row) for row in shares])
        return np.array(
            [
                [isinstance(outcome.outputs.get(goal.name), float) for goal in self.goals]
                + [True] * len(self.space.axes)
                for outcome in outcomes
            ]
        )

    def jacobian(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the derivatives, shape (m, k), by central differences, one-sided at a bound.

        Beside a run that gave no value they are one-sided too, and zero between two such runs: that a run
        fails there tells nothing of how a value depends on a parameter.
        """
        count = len(shares)
        ahead, behind = (np.clip(shares + sign * STEP * np.eye(count), 0, 1) for sign in (1, -1))
        places = np.vstack([ahead, behind])
        found, had = self.many(places), self.had(places)
        at = np.concatenate([np.diag(ahead), np.diag(behind)])[:, None]
        if not had.all():
            found = np.where(had, found, self.one(shares))
            at = np.where(had, at, np.tile(shares, 2)[:, None])
        width = at[:count] - at[count:]
        slopes: NDArray[np.float64] = ((found[:count] - found[count:]) / np.where(width > 0, width, np.inf)).T
        return slopes

    def forward_jacobian(self, shares: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the derivatives, shape (m, k), by one-sided differences inwards: with half the runs."""
        steps = np.where(shares < 0.5, STEP, -STEP)
        places = np.vstack([shares, shares + np.diag(steps)])
        found, had = self.many(places), self.had(places)
        slopes: NDArray[np.float64] = (np.where(had[1:], found[1:] - found[0], 0.0) / steps[:, None]).T
        return slopes


def everywhere(misfit: Misfit, search: Search, tell: Tell) -> NDArray[np.float64]:
    """Search the whole space; return the best shares of the bounds found, shape (k,)."""
    start = np.clip(misfit.space.start, 0, 1)
    if not search.generations:
        return start
    from scipy.optimize import Bounds, differential_evolution  # noqa: PLC0415  # slow to import
    from scipy.stats import qmc  # noqa: PLC0415  # slow to import

    random = np.random.default_rng(search.seed)
    if search.start == "anywhere":
        first = qmc.LatinHypercube(start.size, rng=random).random(search.population)
    else:
        first = np.clip(start + CLOUD * random.standard_normal((search.population, start.size)), 0, 1)
        first[0] = start
    generation = 0

    def report(intermediate_result: object) -> None:
        nonlocal generation
        generation += 1
        worth = float(getattr(intermediate_result, "fun", np.nan))
        tell(f"everywhere: generation {generation} of {search.generations}, {_words(worth, misfit)}")

    def squares(shares: NDArray[np.float64], /) -> Any:  # noqa: ANN401  # one a column: the stubs know only one
        return np.sum(misfit.many(shares.T) ** 2, axis=1)

    found = differential_evolution(
        squares,
        bounds=Bounds(np.zeros(start.size), np.ones(start.size)),
        init=first,
        maxiter=search.generations,
        tol=0.0,
        mutation=(0.4, 0.9),
        recombination=0.9,
        rng=random,
        polish=False,
        vectorized=True,
        updating="deferred",
        callback=report,
    )
    return np.asarray(found.x, dtype=np.float64)


def downhill(
    misfit: Misfit, shares: NDArray[np.float64], steps: int, tell: Tell, *, one_sided: bool = False
) -> NDArray[np.float64]:
    """Go to the bottom of the valley by least squares; return the shares of the bounds there, shape (k,)."""
    if not steps:
        return shares
    from scipy.optimize import least_squares  # noqa: PLC0415  # slow to import

    step = 0

    def slopes(at: NDArray[np.float64]) -> NDArray[np.float64]:
        nonlocal step
        step += 1
        tell(
            f"downhill: step {step} of at most {steps}, {_words(float(np.sum(misfit.one(at) ** 2)), misfit)}"
        )
        return misfit.forward_jacobian(at) if one_sided else misfit.jacobian(at)

    inside = np.clip(shares, 1e-6, 1 - 1e-6)
    found = least_squares(
        misfit.one, inside, jac=slopes, bounds=(0.0, 1.0), max_nfev=steps, xtol=1e-4, ftol=1e-4, gtol=1e-6
    )
    return np.asarray(found.x, dtype=np.float64)


def _words(squares: float, misfit: Misfit) -> str:
    aims = len({goal.curve or goal.name for goal in misfit.goals})
    return f"{np.sqrt(squares / aims):.3f} rms of what counts as one"
