"""Preconditions: a test done outside them is not evaluated, whatever its channels say."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.definitions.units import UNITS, parse_quantity
from certkit.documents.result import PreconditionResult
from certkit.errors import UsageError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Iterable

    from certkit.definitions.procedure import Precondition
    from certkit.signals import Recording
    from certkit.signals.recording import Kind

KELVIN = 273.15

OF_A_LABORATORY = frozenset({"temperature", "humidity", "soak time"})
"""Conditions of a laboratory's room, which a finite-element run does not have."""


def grade_preconditions(
    preconditions: Iterable[Precondition], recording: Recording
) -> list[PreconditionResult]:
    """Hold the conditions of a test against the procedure's preconditions, one row each.

    A condition that was not recorded is `not evaluated`; where the precondition is required, so is the
    whole test.

    Raises
    ------
    UsageError
        When a precondition's limits have units that do not fit its dimension.
    """
    return [
        _grade(precondition, recording.conditions.get(precondition.quantity))
        for precondition in preconditions
        if _applies(precondition, recording.kind)
    ]


def _applies(precondition: Precondition, kind: Kind) -> bool:
    """Tell whether a precondition is asked of a recording; of a finite-element run all but the room's are."""
    if kind == "virtual" and precondition.applies_to == "measured":
        return precondition.quantity not in OF_A_LABORATORY
    return precondition.applies_to in {"both", kind}


def _grade(precondition: Precondition, value: float | None) -> PreconditionResult:
    lower, upper = (_read(precondition, text) for text in precondition.within)
    unit, factor, offset = _unit(precondition)
    row = {
        "quantity": precondition.quantity,
        "unit": unit,
        "lower": (lower - offset) / factor,
        "upper": (upper - offset) / factor,
    }
    if value is None or not math.isfinite(value):
        code = "condition-not-recorded" if value is None else "condition-not-finite"
        return PreconditionResult(
            value=None,
            verdict="not evaluated",
            coded_reason=Reason.of(
                code if precondition.required else f"{code}-not-required", quantity=precondition.quantity
            ),
            required=precondition.required,
            **row,
        )
    # Limits written in degrees or km/h have rounding of their own; a value on the limit is inside.
    slack = 1e-9 * max(abs(lower), abs(upper))
    inside = lower - slack <= value <= upper + slack
    shown = (value - offset) / factor
    first, last = precondition.within
    outside = Reason.of(
        "condition-outside",
        quantity=precondition.quantity,
        value=shown,
        unit=unit,
        lower=first,
        upper=last,
    )
    return PreconditionResult(
        value=shown,
        verdict="pass" if inside else "fail",
        coded_reason=None if inside else outside,
        required=precondition.required,
        **row,
    )


def _read(precondition: Precondition, text: str) -> float:
    try:
        return parse_quantity(text, precondition.dimension)
    except (ValueError, KeyError) as error:
        raise UsageError(f"precondition {precondition.quantity}: {error}") from error


def _unit(precondition: Precondition) -> tuple[str, float, float]:
    """Return the unit that the limits are written in, with its factor and offset to SI."""
    text = precondition.within[1]
    written = text.strip().lstrip("+-0123456789.eE ")
    units = UNITS[precondition.dimension]
    unit = written if written in units else next(iter(units))
    offset = KELVIN if precondition.dimension == "temperature" and unit != "K" else 0.0
    return unit, units[unit], offset
