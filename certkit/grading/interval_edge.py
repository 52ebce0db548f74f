"""Where the assessment interval's end is a knife edge: a peak just outside, another end that decides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.grading.measure import NoInterval
from certkit.grading.measures import method_of
from certkit.grading.trace import EvaluationWindow, trace_of
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from certkit.documents.result import CriterionResult
    from certkit.grading.measure_all import Measurements

NEAR = 0.002
"""Seconds around the interval's end. The zero crossing of a bone that falls by 1 N·m/ms moves by as much with
an offset of 2 N·m. An estimate."""


def interval_edge(measured: Measurements, criteria: Sequence[CriterionResult]) -> list[Reason]:
    """Return a remark for each graded criterion that the interval's end decides on.

    Parameters
    ----------
    measured : Measurements
    criteria : sequence of CriterionResult
        The graded criteria of the same procedure.
    """
    if isinstance(measured.interval, NoInterval):
        return []
    start, end = measured.interval.start, measured.interval.end
    graded = {criterion.id: criterion for criterion in criteria if criterion.graded}
    said = []
    for criterion in measured.procedure.criteria:
        result = graded.get(criterion.id)
        if criterion.interval != "assessment interval" or result is None or result.value is None:
            continue
        try:
            window = EvaluationWindow(start, min(measured.window.end, end + NEAR))
            trace = trace_of(criterion, measured.filtered, window)
        except DataError:
            continue
        method = method_of(criterion.measure)
        signed = method.turned(trace.y) * trace.y_dimension.scale
        if not method.is_peak or trace.time[0] > end - NEAR:
            continue
        inside = float(signed[trace.time <= end].max())
        shorter = float(signed[trace.time <= end - NEAR].max())
        longer, at = float(signed.max()), float(trace.time[int(np.argmax(signed))])
        moved = max(longer - inside, inside - shorter)
        if result.margin is not None and moved > abs(result.margin):
            said.append(
                Reason.of(
                    "interval-end-decides",
                    criterion=criterion.id,
                    moved=moved,
                    unit=result.unit,
                    margin=abs(result.margin),
                )
            )
        elif longer > inside and _is_peak(signed, trace.time, end):
            said.append(
                Reason.of(
                    "peak-near-interval",
                    criterion=criterion.id,
                    value=longer,
                    unit=result.unit,
                    time=at * 1e3,
                    end=end * 1e3,
                )
            )
    return said


def _is_peak(signed: NDArray[np.float64], time: NDArray[np.float64], end: float) -> bool:
    """Tell whether the largest value outside is a peak: it lies between smaller ones."""
    index = int(signed.argmax())
    return 0 < index < signed.size - 1 and float(time[index]) > end
