"""Preconditions: a test done outside them is not evaluated, whatever its channels say."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.definitions.units import from_si, parse_quantity, unit_of
from certkit.documents.result import PreconditionResult
from certkit.errors import UsageError
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Iterable

    from certkit.definitions.procedure import Precondition
    from certkit.signals import Recording
    from certkit.signals.recording import RecordingKind

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
        grade_precondition(precondition, recording.conditions.get(precondition.quantity))
        for precondition in preconditions
        if _applies(precondition, recording.kind)
    ]


def _applies(precondition: Precondition, kind: RecordingKind) -> bool:
    """Tell whether a precondition is asked of a recording; of a finite-element run all but the room's are."""
    if kind == "virtual" and precondition.applies_to == "measured":
        return precondition.quantity not in OF_A_LABORATORY
    return precondition.applies_to in {"both", kind}


def grade_precondition(precondition: Precondition, value: float | None) -> PreconditionResult:
    """Hold one condition (SI) against what is asked of it."""
    lower, upper = (_read(precondition, text) for text in precondition.within)
    dimension, unit = precondition.dimension, unit_of(precondition.within[1])
    row = {
        "quantity": precondition.quantity,
        "unit": unit,
        "lower": from_si(lower, dimension, unit),
        "upper": from_si(upper, dimension, unit),
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
    shown = from_si(value, dimension, unit)
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
