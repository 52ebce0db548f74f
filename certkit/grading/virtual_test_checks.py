"""Quality of a finite-element run: rows beside the preconditions, one for each limit of `virtual-test`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.definitions.units import dimensions, from_si, parse_quantity, unit_of
from certkit.documents.result import PreconditionResult
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.corridor_set import CorridorSet, ValueWindow

LIMITS = "virtual-test"
"""Name of the corridor set with the limits."""
ONLY_DYNAMIC = frozenset({"free flight"})
"""Quantities that a static test does not have."""
SLACK = 1e-9
"""Relative rounding of a limit that is written in per cent."""


def run_checks(
    limits: CorridorSet, conditions: Mapping[str, float], *, static: bool
) -> tuple[PreconditionResult, ...]:
    """Hold what a run tells of its own quality against the limits.

    Parameters
    ----------
    limits : CorridorSet
        Its windows have the conditions' names.
    conditions : mapping of str to float
        SI.
    static : bool
        Nothing flies in the test.

    Returns
    -------
    tuple of PreconditionResult
        A condition that nobody tells is `not evaluated`; all are required.
    """
    return tuple(
        _row(name, window, conditions.get(name))
        for name, window in limits.windows.items()
        if not (static and name in ONLY_DYNAMIC)
    )


def certification_check(name: str, certification: str | None) -> PreconditionResult:
    """Ask that the legform's model names the certification of its own that it has passed."""
    missing = Reason.of("model-not-certified", model=name)
    return PreconditionResult(
        quantity="certification of the legform model",
        value=None,
        unit="",
        verdict="pass" if certification else "not evaluated",
        coded_reason=Reason.of("model-certified", model=name, certification=certification)
        if certification
        else missing,
    )


def _row(name: str, window: ValueWindow, value: float | None) -> PreconditionResult:
    text = window.upper or window.lower or ""
    dimension, unit = dimensions(text)[0], unit_of(text)
    lower, upper = (
        None if side is None else parse_quantity(side, dimension) for side in (window.lower, window.upper)
    )
    shown = {
        "quantity": name,
        "unit": unit,
        "lower": None if lower is None else from_si(lower, dimension, unit),
        "upper": None if upper is None else from_si(upper, dimension, unit),
        "confidence": window.confidence,
        "source": window.source or "",
    }
    if value is None or not math.isfinite(value):
        reason = Reason.of("run-does-not-tell", quantity=name)
        return PreconditionResult(value=None, verdict="not evaluated", coded_reason=reason, **shown)
    slack = SLACK * max(abs(side) for side in (lower, upper) if side is not None)
    inside = (lower is None or value >= lower - slack) and (upper is None or value <= upper + slack)
    figure = from_si(value, dimension, unit)
    outside = Reason.of("run-outside", quantity=name, value=figure, unit=unit, limits=window.lines()[""])
    return PreconditionResult(
        value=figure,
        verdict="pass" if inside else "fail",
        coded_reason=None if inside else outside,
        **shown,
    )
