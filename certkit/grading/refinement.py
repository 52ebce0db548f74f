"""Numerical uncertainty from step refinement: the grid convergence index of ASME V&V 20-2009.

The value that is reported comes from the run at the step h, another run uses h/2.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Mapping

ORDER = 2.0
"""Order of the leapfrog scheme, which two runs cannot show."""

SAFETY = 3.0
"""Safety factor where the formal order has to be believed."""


def numerical_uncertainties(
    reported: Mapping[str, float | None], halved: Mapping[str, float | None]
) -> dict[str, float]:
    """Return the grid convergence index F·|f₁ − f₂|·2ᵖ / (2ᵖ − 1) of every criterion that both runs measured.

    Parameters
    ----------
    reported, halved : mapping of str to float or None
        Criterion values by id, at h and at h/2.

    Returns
    -------
    dict of str to float
        In the unit of the values; only what is finite.
    """
    growth = math.pow(2.0, ORDER)
    changes = {
        name: abs(value - other)
        for name, value in reported.items()
        if value is not None and (other := halved.get(name)) is not None
    }
    return {
        name: SAFETY * change * growth / (growth - 1.0)
        for name, change in changes.items()
        if math.isfinite(change)
    }


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
