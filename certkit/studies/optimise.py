"""Optimisation: settings that keep every criterion inside with a margin, and what two aims cost each other.

Scipy's differential evolution, generation by generation, so that all processes have work. Settings that
break a limit are ranked by how far they break it, so the search finds its way in from anywhere.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct, field

from certkit.definitions.loading.error_messages import suggestion
from certkit.errors import RunError, UsageError
from certkit.grading.asked_criterion import asked_criterion
from certkit.studies.check_runs import check_runs
from certkit.studies.designs.shares import at_shares
from certkit.studies.factors import Factor, Uniform
from certkit.studies.quantity import share, written
from certkit.studies.run_table import table_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import pandas as pd
    from numpy.typing import NDArray

    from certkit.definitions.study import Aim, Optimisation, Study
    from certkit.studies.points import Outcome, Point
    from certkit.studies.runs import Runs
    from certkit.studies.trial import Trial

FAILED = 10.0
"""How far out a run counts that failed or lacks a graded value, in limits."""

PENALTY = 100.0
WALKS = 7
"""Weightings of two aims along the trade-off curve, where there are runs enough for as many."""

WALK = 40
"""Runs below which a walk is not worth its while."""


class Limit(Struct, frozen=True):
    """What an output has to keep: at least `lower`, at most `upper`, in its unit."""

    lower: float | None
    upper: float | None

    def slack(self, value: float, margin: float) -> float:
        """Return by which part of the limit a value is better than needed; negative when it is worse."""
        sides = []
        if self.upper is not None:
            sides.append((self.upper - value) / _size(self.upper) - margin)
        if self.lower is not None:
            sides.append((value - self.lower) / _size(self.lower) - margin)
        return min(sides)


def _size(limit: float) -> float:
    return abs(limit) if limit else 1.0


class Optimum(Struct, frozen=True):
    """What an optimisation found.

    Parameters
    ----------
    name, title : str
    factors : tuple of Factor
    table : DataFrame
        Every run; see `certkit.studies.run_table`.
    best : int
        Row of the best run, from 0.
    keeps : bool
        Whether it keeps all limits with the margin.
    slack : float
        By which part of its limit the tightest criterion of the best run is better than needed.
    aims : tuple of Aim
    curve : tuple of int
        Rows that keep all limits and that no other one beats in both aims, along the trade-off.
    settings : tuple of str
        The best settings as `path=value`, for `--set`.
    output_units : mapping of str to str
    """

    name: str
    title: str
    factors: tuple[Factor, ...]
    table: pd.DataFrame
    best: int
    keeps: bool
    slack: float
    aims: tuple[Aim, ...]
    curve: tuple[int, ...]
    settings: tuple[str, ...]
    output_units: Mapping[str, str] = field(default_factory=dict)


def limits_of(trial: Trial) -> dict[str, Limit]:
    """Return the limits of all graded outputs of a study.

    Raises
    ------
    UsageError
        When nothing is graded, so that there is nothing to keep.
    """
    found = {}
    for name in trial.procedures:
        setup = trial.prepared(name, {})
        channels = setup.legform.channel_table
        for criterion in setup.procedure.criteria:
            asked = asked_criterion(criterion, setup.corridors, channels)
            if (asked.lower, asked.upper) != (None, None):
                found[f"{name}/{criterion.id}"] = Limit(asked.lower, asked.upper)
    if not found:
        raise UsageError("none of the procedures has a graded value: there are no limits to keep")
    return found


def optimise(sheet: Study, factors: Sequence[Factor], held: Mapping[str, Limit], runs: Runs) -> Optimum:
    """Search for the best settings.

    Parameters
    ----------
    sheet : Study
        With `optimise`.
    factors : sequence of Factor
        Uniform ones; their ends are the bounds.
    held : mapping of str to Limit
        From `limits_of`.
    runs : Runs

    Raises
    ------
    UsageError
        When a parameter is no range of numbers, the margin no share, or an aim no number of the runs.
    RunError
        When not a single run succeeded.
    """
    wanted = sheet.optimise
    margin = share(wanted.margin) if wanted else None
    if wanted is None or margin is None:
        raise UsageError("`optimise` needs a margin that is a share of the limits, such as `10 %`")
    wrong = [factor.name for factor in factors if not isinstance(factor.distribution, Uniform)]
    if wrong:
        raise UsageError(f"{wrong[0]}: a parameter to optimise needs `uniform` bounds")
    check_runs(wanted.evaluations, len(factors), "search")
    search = _Search(factors, held, margin, wanted, runs)
    ways = [(1.0, 0.0)]
    if len(wanted.aims) == 2:
        walks = min(WALKS, wanted.evaluations // WALK)
        ways = [(1.0 - w, float(w)) for w in np.linspace(0, 1, walks)] if walks > 1 else [(0.5, 0.5)]
    for number, weights in enumerate(ways):
        search.walk(weights, wanted.seed + number, max(2, wanted.evaluations // len(ways)))
    return search.optimum(sheet)


class _Search:
    """All runs of an optimisation so far, and what they are worth."""

    def __init__(
        self,
        factors: Sequence[Factor],
        held: Mapping[str, Limit],
        margin: float,
        wanted: Optimisation,
        runs: Runs,
    ) -> None:
        self.factors, self.held, self.margin, self.wanted, self.runs = factors, held, margin, wanted, runs
        self.points: list[Point] = []
        self.outcomes: list[Outcome] = []
        self.scales: list[float] = []

    def walk(self, weights: tuple[float, float], seed: int, evaluations: int) -> None:
        """Search with one weighting of the aims, at most about that many runs."""
        from scipy.optimize import Bounds, differential_evolution  # noqa: PLC0415  # slow to import
        from scipy.stats import qmc  # noqa: PLC0415  # slow to import

        count = len(self.factors)
        population = int(np.clip(evaluations // 10, min(8, evaluations // 2), 8 * count + 8))
        random = np.random.default_rng(seed)

        def worth(shares: NDArray[np.float64], /) -> Any:  # noqa: ANN401  # one a column: the stubs know only one
            return np.array([self._worth(outcome, weights) for outcome in self._run(shares.T)])

        differential_evolution(
            worth,
            bounds=Bounds(np.zeros(count), np.ones(count)),
            init=qmc.LatinHypercube(count, rng=random).random(population),
            maxiter=max(1, evaluations // population - 1),
            tol=0.0,
            mutation=(0.4, 0.9),
            recombination=0.8,
            rng=random,
            polish=False,
            vectorized=True,
            updating="deferred",
        )

    def _run(self, shares: NDArray[np.float64]) -> list[Outcome]:
        points = at_shares(self.factors, shares)
        outcomes = self.runs(points)
        self.points += points
        self.outcomes += outcomes
        if not self.scales:
            # Aims of different units are compared by the size they have in the first generation.
            for aim in self.wanted.aims:
                known = [v for o in outcomes if isinstance(v := o.outputs.get(aim.output), float)]
                ran = {name for o in outcomes for name, v in o.outputs.items() if isinstance(v, float)}
                if ran and not known:
                    raise UsageError(f"no run gives the aim {aim.output}; {suggestion(aim.output, ran)}")
                self.scales.append(float(np.median(np.abs(known))) or 1.0 if known else 1.0)
        return outcomes

    def slack(self, outcome: Outcome) -> float:
        """Return the slack of the tightest criterion."""
        values = [outcome.outputs.get(name) for name in self.held]
        return min(
            limit.slack(value, self.margin) if isinstance(value, float) else -FAILED
            for value, limit in zip(values, self.held.values(), strict=True)
        )

    def aims(self, outcome: Outcome) -> list[float]:
        """Return the aims as numbers to be made small, of the order of one."""
        found = []
        for aim, scale in zip(self.wanted.aims, self.scales, strict=True):
            value = outcome.outputs.get(aim.output)
            sign = 1.0 if aim.direction == "minimise" else -1.0
            found.append(sign * value / scale if isinstance(value, float) else FAILED)
        return found

    def _worth(self, outcome: Outcome, weights: tuple[float, float]) -> float:
        slack = self.slack(outcome)
        aims = self.aims(outcome)
        if not aims:
            return -slack
        # The sum keeps the curve's ends from bending back where the larger one alone would not care.
        shares = [w * a for w, a in zip(weights, aims, strict=False)]
        return max(shares) + 0.1 * sum(shares) + PENALTY * max(0.0, -slack)

    def optimum(self, sheet: Study) -> Optimum:
        """Choose the best of all runs."""
        if all(outcome.error for outcome in self.outcomes):
            raise RunError(
                f"not a single run succeeded; the first one: {self.outcomes[0].error}"
                "; correct the study or its definitions"
            )
        slacks = np.array([self.slack(outcome) for outcome in self.outcomes])
        aims = np.array([self.aims(outcome) for outcome in self.outcomes]).reshape(len(slacks), -1)
        keeps = slacks >= 0
        worth = np.where(keeps & (aims.shape[1] > 0), aims.sum(axis=1), np.inf)
        best = int(worth.argmin()) if np.isfinite(worth).any() else int(slacks.argmax())
        units = {factor.name: factor.unit for factor in self.factors}
        return Optimum(
            name=sheet.study,
            title=sheet.title,
            factors=tuple(self.factors),
            table=table_of(self.points, self.outcomes),
            best=best,
            keeps=bool(keeps[best]),
            slack=float(slacks[best]),
            aims=tuple(self.wanted.aims),
            curve=_front(aims, keeps) if aims.shape[1] == 2 else (),
            settings=tuple(f"{name}={written(v, units[name])}" for name, v in self.points[best].items()),
        )


def _front(aims: NDArray[np.float64], keeps: NDArray[np.bool_]) -> tuple[int, ...]:
    """Return the rows that keep the limits and that no other such row beats in both aims."""
    rows = [int(i) for i in np.flatnonzero(keeps)]
    rows.sort(key=lambda i: (aims[i, 0], aims[i, 1]))
    front: list[int] = []
    for i in rows:
        if not front or aims[i, 1] < aims[front[-1], 1]:
            front.append(i)
    return tuple(front)
