"""Numerical uncertainty from step refinement: the grid convergence index of ASME V&V 20-2009.

The value that is reported comes from the coarsest of the runs, at step h; the others used h/2 and, where
there is a third, h/4.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

FORMAL_ORDER = 2.0
"""Order of the leapfrog scheme."""
SAFETY_OBSERVED = 1.25
"""Safety factor where three runs show the order."""
SAFETY_ASSUMED = 3.0
"""Safety factor where the formal order has to be believed."""
LOWEST_ORDER = 0.5
NOTHING = 1e-12
"""A change this small (relative) is rounding."""


def numerical_uncertainty(values: Sequence[float]) -> float:
    """Return the grid convergence index of the first value.

    With three values the observed order p = log₂(|f₁ − f₂| / |f₂ − f₃|) is used where the changes go one
    way and 0.5 ≤ p, limited to the formal order 2, with the factor 1.25. Otherwise p = 2 is assumed with
    the factor 3; where the changes even grow, the largest change itself times 3 is taken. The index of the
    coarse run is F·|f₁ − f₂|·2ᵖ / (2ᵖ − 1).

    Parameters
    ----------
    values : sequence of float
        At h, h/2 and perhaps h/4.

    Returns
    -------
    float
        In the unit of the values.

    Raises
    ------
    UsageError
        When there are not two or three values.
    """
    if len(values) not in {2, 3}:
        raise UsageError(f"a refinement needs two or three runs, not {len(values)}")
    if not all(math.isfinite(value) for value in values):
        return math.inf
    first = values[0] - values[1]
    factor, order = SAFETY_ASSUMED, FORMAL_ORDER
    if len(values) == 3:
        second = values[1] - values[2]
        rounding = NOTHING * max(abs(value) for value in values)
        if abs(second) > max(abs(first), rounding):
            return SAFETY_ASSUMED * abs(second)
        if abs(second) > rounding and first * second > 0:
            observed = math.log2(abs(first) / abs(second))
            if observed >= LOWEST_ORDER:
                factor, order = SAFETY_OBSERVED, min(observed, FORMAL_ORDER)
    growth = math.pow(2.0, order)
    return factor * abs(first) * growth / (growth - 1.0)


def numerical_uncertainties(runs: Sequence[Mapping[str, float | None]]) -> dict[str, float]:
    """Return the grid convergence index of every criterion that all runs measured.

    Parameters
    ----------
    runs : sequence of mapping of str to float or None
        Criterion values by id, the reported run first.
    """
    found = {}
    for name in runs[0]:
        values = [value for run in runs if (value := run.get(name)) is not None]
        if len(values) == len(runs):
            uncertainty = numerical_uncertainty(values)
            if math.isfinite(uncertainty):
                found[name] = uncertainty
    return found


class StepChange(Struct, frozen=True):
    """The criterion that a finer run changes most.

    Parameters
    ----------
    percent : float
        Of its value, or of its floor where that is larger; infinite where one run did not measure it.
    criterion : str
        Its id; empty where nothing changed.
    """

    percent: float
    criterion: str


def largest_step_change(
    reported: Mapping[str, float | None],
    refined: Mapping[str, float | None],
    floor: Mapping[str, float] | None = None,
) -> StepChange:
    """Return the largest change of a criterion from one run to a finer one.

    Parameters
    ----------
    reported, refined : mapping of str to float or None
        Values by id, of the criteria that the verdict rests on.
    floor : mapping of str to float, optional
        Smallest size that a change is taken relative to, by id: a peak of nearly zero has no meaningful
        percentage.
    """
    largest = StepChange(0.0, "")
    for name, value in reported.items():
        other = refined.get(name)
        if value is None and other is None:
            continue
        if value is None or other is None:
            return StepChange(math.inf, name)
        size = max(abs(value), (floor or {}).get(name, 0.0))
        if value == other:
            continue
        percent = abs(other - value) / size * 100.0 if size > 0 else math.inf
        if not percent <= largest.percent:
            largest = StepChange(percent, name)
    return largest
