"""What a pass rests on, in at most three lines: its peaks, its limits, its model or its conditions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.result import CALIBRATION
from certkit.grading.relative_margin import relative_margin
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import CriterionResult, PreconditionResult
    from certkit.grading.measure_all import Measurements


def foundation(
    measured: Measurements,
    criteria: Sequence[CriterionResult],
    preconditions: Sequence[PreconditionResult],
    *,
    model: str,
    fitted: Sequence[Reason],
) -> list[Reason]:
    """Return the lines that stand first beside a pass.

    Parameters
    ----------
    measured : Measurements
    criteria : sequence of CriterionResult
        All of them; graded ones pass.
    preconditions : sequence of PreconditionResult
        Of a measured test.
    model : str
        Title of the simulated leg; empty for a measured test.
    fitted : sequence of Reason
        What the model was fitted to, where that is what the verdict is about.
    """
    graded = [criterion for criterion in criteria if criterion.graded]
    return [
        *_peaks(measured, graded),
        *_limits(graded),
        *(_model(model, fitted) if model else _conditions(preconditions)),
    ]


def _peaks(measured: Measurements, graded: Sequence[CriterionResult]) -> list[Reason]:
    time = measured.recording.time
    ranked = [(share, c) for c in graded if (share := relative_margin(c)) is not None]
    if not ranked or measured.procedure.test_kind == "static" or time.size == 0:
        return []
    nearest = min(ranked, key=lambda pair: pair[0])[1]
    return [
        Reason.of(
            "pass-rests-on-peaks",
            count=len(graded),
            start=float(time[0]) * 1e3,
            end=float(time[-1]) * 1e3,
            criterion=nearest.id,
            margin=nearest.margin or 0.0,
            unit=nearest.unit,
        )
    ]


def _limits(graded: Sequence[CriterionResult]) -> list[Reason]:
    sets: dict[tuple[str, str], list[str]] = {}
    for criterion in graded:
        name = criterion.corridor.partition("/")[0]
        sets.setdefault((name, criterion.confidence or "estimated"), []).append(criterion.id)
    origins = [
        Reason.of("limit-origin", set=name, confidence=confidence) for name, confidence in sorted(sets)
    ]
    return [Reason.of("pass-rests-on-limits", origins=origins)] if origins else []


def _model(model: str, fitted: Sequence[Reason]) -> list[Reason]:
    if fitted:
        return [Reason.of("pass-rests-on-fitted-model", model=model, fits=list(fitted))]
    return [Reason.of("pass-rests-on-model", model=model)]


def _conditions(preconditions: Sequence[PreconditionResult]) -> list[Reason]:
    # Calibrations are counted, not listed.
    calibrations = [row for row in preconditions if row.quantity.startswith(CALIBRATION)]
    others = [row for row in preconditions if row not in calibrations]
    kept = [row.quantity for row in others if row.verdict == "pass"]
    open_ones = [row.quantity for row in others if row.verdict != "pass"]
    rest = [Reason.of("conditions-open", conditions=open_ones)] if open_ones else []
    if calibrations:
        rest.insert(0, Reason.of("calibrations-valid", count=len(calibrations)))
    if not kept:
        return []
    return [Reason.of("pass-rests-on-conditions", conditions=kept, rest=rest)]
