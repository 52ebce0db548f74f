"""Quality of a finite-element run: rows beside the preconditions, one for each limit of `virtual-test`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.definitions.units import UNITS, parse_quantity
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
    dimension, unit = _unit(text)
    factor = UNITS[dimension][unit]
    lower, upper = (
        None if side is None else parse_quantity(side, dimension) for side in (window.lower, window.upper)
    )
    shown = {
        "quantity": name,
        "unit": unit,
        "lower": None if lower is None else lower / factor,
        "upper": None if upper is None else upper / factor,
        "confidence": window.confidence,
        "source": window.source or "",
    }
    if value is None or not math.isfinite(value):
        reason = Reason.of("run-does-not-tell", quantity=name)
        return PreconditionResult(value=None, verdict="not evaluated", coded_reason=reason, **shown)
    slack = SLACK * max(abs(side) for side in (lower, upper) if side is not None)
    inside = (lower is None or value >= lower - slack) and (upper is None or value <= upper + slack)
    outside = Reason.of(
        "run-outside", quantity=name, value=value / factor, unit=unit, limits=window.lines()[""]
    )
    return PreconditionResult(
        value=value / factor,
        verdict="pass" if inside else "fail",
        coded_reason=None if inside else outside,
        **shown,
    )


def _unit(text: str) -> tuple[str, str]:
    """Return dimension and unit of a limit: a ratio in per cent, or a time."""
    written = text.strip().lstrip("+-0123456789.eE ")
    return next(((d, written) for d in ("ratio", "time") if written in UNITS[d]), ("ratio", ""))
