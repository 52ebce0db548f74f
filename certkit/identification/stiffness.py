"""Step 5: the law of each path from its force and shortening.

The loading curve is a piecewise-linear fit to the instants at which the shortening is the largest so far;
then the unloading branch and the damper are those that best repeat the whole history. A damper is kept only
where it earns its place.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.identification.curve_points import continued, simplified
from certkit.identification.path_energy import path_energy
from certkit.identification.spring_law import Branch, SpringLaw

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Values = NDArray[np.float64]

KNOTS = 60
ROUGH_KNOTS = 20
ROUGH = 5.0
"""Where a law with many knots misses its history by more than this (% rms), they would follow noise."""

NO_CURVE = 15.0
FEWEST_KNOTS = 6
"""Where even the rough law misses by more than `NO_CURVE`, force is hardly a function of shortening."""

SIMPLIFY = 0.002
"""Points of the loading curve may be left out as long as it moves by less than this share of its peak.

A twentieth of the law's misfit is added: points that describe noise are worth nothing.
"""

VIRGIN = 0.003
"""A shortening within this share of the range below its largest value so far still counts as loading."""

DAMPER_GAIN = 0.75
"""A damper is kept when it brings the rms misfit below this share of the misfit without one.

One impact hardly tells a damper from a stiffer curve: for a few per cent of misfit a quarter of the force may
go from the one to the other, so a damper has to explain something that the curve cannot.
"""

UNSEEN = 0.1
"""Share of the other side's travel below which a side of a two-way spring takes the other's stiffness."""

HELD = 30.0
"""Weight of the absorbed energy's error, over the energy put in, against the rms error of the force.

The energy then comes back within some tenths of a per cent.
"""

STARTS = ((1.5, 0.05, 0.0), (4.0, 0.3, 0.0), (12.0, 0.1, 0.2), (4.0, 0.0, 0.0))
"""First guesses of (unloading stiffness ÷ secant, residual share, permanent set)."""


class SpringFit(Struct, frozen=True):
    """A path's law and how well it repeats the history it came from.

    Parameters
    ----------
    law : SpringLaw
    misfit : float
        rms difference between the law along the history and the force, in per cent of the largest force.
    unloaded : bool
        Whether the history unloads far enough to show the branch.
    """

    law: SpringLaw
    misfit: float
    unloaded: bool


def fit_law(x: Values, v: Values, force: Values, *, tension: bool, hold_energy: bool) -> SpringFit | None:
    """Find the law of one path.

    Parameters
    ----------
    x, v, force : ndarray, shape (n,)
        Shortening in m, its rate in m/s and force in N.
    tension : bool
        Whether the path can pull.
    hold_energy : bool
        Whether the unloading branch has to absorb what the path has absorbed, for the run's rebound.

    Returns
    -------
    SpringFit or None
        None when the path never carries a force or never shortens.
    """
    peak = float(np.max(np.abs(force)))
    span = float(np.ptp(x))
    if peak <= 0 or span <= 1e-7:
        return None
    problem = _Problem(x, v, force, tension=tension, peak=peak)
    problem.put_in = path_energy(x, force).put_in if hold_energy else 0.0
    if not problem.has_force:
        return None
    fit = _fitted(problem)
    for most, knots in ((ROUGH, ROUGH_KNOTS), (NO_CURVE, FEWEST_KNOTS)):
        if fit.misfit > most:
            problem.knots = knots
            fit = _fitted(problem)
    return replace(fit, law=continued(simplified(fit.law, SIMPLIFY + 5e-4 * fit.misfit)))


def _fitted(problem: _Problem) -> SpringFit:
    if not problem.unloads:
        law = problem.law(Branch(4.0 * problem.secant), 0.0)
        return SpringFit(law, problem.misfit(law), unloaded=False)
    bare = problem.best(STARTS)
    branch = bare.branch
    start = (branch.stiffness / problem.secant, branch.residual, branch.permanent_set, 0.1)
    damped = problem.best((start,))
    keep = problem.misfit(damped) < DAMPER_GAIN * problem.misfit(bare)
    law = damped if keep else bare
    return SpringFit(law, problem.misfit(law), unloaded=True)


class _Problem:
    """One path's history, and the laws that can be laid through it."""

    def __init__(self, x: Values, v: Values, force: Values, *, tension: bool, peak: float) -> None:
        self.x, self.v, self.force, self.tension, self.peak = x, v, force, tension, peak
        self.pushed = np.maximum(x, 0.0)
        self.knots = KNOTS
        self.put_in = 0.0
        self.start = 0.0 if tension else self._onset()
        self.top = float(np.max(self.pushed))
        self.has_force = self.top > self.start or (tension and float(np.min(x)) < 0)
        reached = max(self.top, float(-np.min(x)) if tension else 0.0)
        self.secant = peak / max(reached - self.start, 0.05 * reached, 1e-6)

    @property
    def unloads(self) -> bool:
        """Tell whether the history shows an unloading branch: force falls after the largest shortening."""
        x = np.abs(self.x) if self.tension else self.pushed
        k = int(np.argmax(x))
        after = np.abs(self.force[k:])
        return float(np.min(after)) < 0.5 * float(after[0]) or float(x[k] - np.min(x[k:])) > 0.05 * float(
            x[k]
        )

    def _onset(self) -> float:
        """Return the largest shortening before the path first carries one per cent of its peak force."""
        loaded = np.flatnonzero(self.force > 0.01 * self.peak)
        if loaded.size == 0 or loaded[0] == 0:
            return 0.0
        return max(float(np.max(self.pushed[: loaded[0]])), 0.0)

    def law(self, branch: Branch, damping: float) -> SpringLaw:
        """Lay a loading curve through the loading instants, given the branch and the damper."""
        push = _curve(self.pushed, self.force - damping * self.v, self.start, self.top, self.knots)
        shortening, force = push
        if self.tension:
            one = SpringLaw(tuple(shortening), tuple(force), branch)
            rest = one.rest_length(self.pushed)
            y = np.maximum(rest - self.x, 0.0)
            pull_x, pull_f = _curve(y, -(self.force - damping * self.v), 0.0, float(np.max(y)), self.knots)
            if pull_x[-1] < UNSEEN * self.top:
                pull_x, pull_f = _as_the_other_side(shortening, force)
            elif self.top < UNSEEN * pull_x[-1]:
                shortening, force = _as_the_other_side(pull_x, pull_f)
            shortening = np.concatenate([-pull_x[:0:-1], shortening])
            force = np.concatenate([-pull_f[:0:-1], force])
        return SpringLaw(
            tuple(map(float, shortening)), tuple(map(float, force)), branch, damping, self.tension
        )

    def misfit(self, law: SpringLaw) -> float:
        """Return the rms misfit in per cent of the peak, over the instants where something acts."""
        model = law.total_force(self.x, self.v)
        acting = (np.abs(self.force) > 0.01 * self.peak) | (np.abs(model) > 0.01 * self.peak)
        return float(100 * np.sqrt(np.mean((model - self.force)[acting] ** 2)) / self.peak)

    def best(self, starts: Sequence[tuple[float, ...]]) -> SpringLaw:
        """Search the branch, and the damper where the starts have a fourth value, by least squares."""
        from scipy.optimize import least_squares  # noqa: PLC0415  # 0.9 s, only here

        damped = len(starts[0]) > 3
        fastest = float(np.max(np.abs(self.v))) or 1.0
        most = 0.5 * self.peak / fastest

        def law_of(p: Values) -> SpringLaw:
            branch = Branch(self.secant * float(np.exp(p[0])), float(p[1]), float(p[2]))
            return self.law(branch, float(p[3]) * most if damped else 0.0)

        def residuals(p: Values) -> Values:
            off = law_of(p).total_force(self.x, self.v) - self.force
            if self.put_in <= 0:
                return off / self.peak
            absorbed = path_energy(self.x, off).absorbed / self.put_in
            return np.append(off / self.peak, HELD * np.sqrt(off.size) * absorbed)

        lower = np.array([0.0, 0.0, 0.0, 0.0])[: len(starts[0])]
        upper = np.array([np.log(200.0), 0.95, 0.95, 1.0])[: len(starts[0])]
        found = []
        for ratio, *others in starts:
            start = np.clip([np.log(ratio), *others], lower + 1e-3, upper - 1e-3)
            steps = [1e-3] * len(start)
            fit = least_squares(
                residuals, start, bounds=(lower, upper), diff_step=steps, ftol=1e-5, max_nfev=40
            )
            found.append((float(fit.cost), tuple(fit.x)))
        return law_of(np.array(min(found)[1]))


def _as_the_other_side(x: Values, force: Values) -> tuple[Values, Values]:
    """Return a straight line with the initial stiffness of the side that was seen."""
    near = UNSEEN * float(x[-1])
    return np.array([0.0, near]), np.array([0.0, float(np.interp(near, x, force))])


def _curve(x: Values, force: Values, start: float, top: float, count: int) -> tuple[Values, Values]:
    """Fit a piecewise-linear curve, zero up to `start`, to the loading instants of x ≥ 0.

    A small second-difference penalty carries the curve over knots that few instants fall on.
    """
    if top <= start:
        return np.array([0.0, max(start, 1e-6)]), np.zeros(2)
    virgin = (x >= np.maximum.accumulate(x) - VIRGIN * top) & (x > start)
    # After the largest value, only instants at the very top are still loading.
    knots = np.linspace(start, top, count + 1)
    width = knots[1] - knots[0]
    place = np.clip((x[virgin] - start) / width, 0, count)
    left = np.minimum(place.astype(int), count - 1)
    values = _knot_values(left, place - left, force[virgin], count)
    # Where few instants fall on many knots, the fit may shoot beyond what was seen.
    curve = np.clip(values, 0.0, max(float(np.max(force[virgin], initial=0.0)), 0.0))
    curve = np.concatenate([[0.0], curve])
    if start > 0:
        return np.concatenate([[0.0], knots]), np.concatenate([[0.0], curve])
    return knots, curve


def _knot_values(left: NDArray[np.int64], share: Values, force: Values, count: int) -> Values:
    """Solve for the values at all knots but the first, which is zero: hats with a smoothness penalty.

    The normal equations have five diagonals, so this takes microseconds where a dense solver takes
    milliseconds.
    """
    from scipy.linalg import solveh_banded  # noqa: PLC0415  # 0.9 s, only here

    size = count + 1
    diagonal = np.bincount(left, (1 - share) ** 2, size) + np.bincount(left + 1, share**2, size)
    beside = np.bincount(left, (1 - share) * share, size)
    target = np.bincount(left, (1 - share) * force, size) + np.bincount(left + 1, share * force, size)
    penalty = 1e-6 * max(left.size, 1) / count
    bands = np.zeros((3, size))
    bands[2], bands[1, 1:] = diagonal, beside[:-1]
    bands[2, :-2] += penalty
    bands[2, 1:-1] += 4 * penalty
    bands[2, 2:] += penalty
    bands[1, 1:-1] -= 2 * penalty
    bands[1, 2:] -= 2 * penalty
    bands[0, 2:] += penalty
    bands[2] += 1e-12 * penalty  # a lone knot must not make the matrix singular
    return np.asarray(solveh_banded(bands[:, 1:], target[1:]))
