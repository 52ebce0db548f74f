"""Error tables like the paper's Table 1.

The error is (simulation − test) / test. The paper prints it in whole percent; its published column is shown
the same way, and the rms of these rounded errors is the 16.2 % that the paper's table gives. Our own errors
and their rms are not rounded.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from certkit.documents.result import Comparison, ComparisonRow
from certkit.errors import UsageError
from certkit.grading.quantities import in_unit
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from certkit.definitions.reference import Reference
    from certkit.documents.result import CriterionResult


def error_percent(simulation: float, test: float) -> float:
    """Return (simulation − test) / test in percent.

    Raises
    ------
    UsageError
        When the test value is zero or not finite: no relative error exists then.
    """
    if test == 0 or not math.isfinite(test):
        raise UsageError(
            f"no relative error against a test value of {test}; leave the channel out of the reference"
        )
    return (simulation - test) / test * 100.0


def whole_percent(error: float) -> float:
    """Round to whole percent as the paper does, halves away from zero."""
    return math.copysign(math.floor(abs(error) + 0.5), error) if abs(error) >= 0.5 else 0.0


def rms(errors: Sequence[float]) -> float:
    """Return the root mean square of errors."""
    return math.sqrt(sum(error * error for error in errors) / len(errors))


def compare(reference: Reference, criteria: Iterable[CriterionResult]) -> Comparison | None:
    """Make the error table of measured criteria against reference data.

    Returns
    -------
    Comparison or None
        None when not one of the reference's criteria was measured. Those that are missing are named in the
        notes.

    Raises
    ------
    UsageError
        When a reference value's unit is not one of its criterion's channel.
    """
    values = {criterion.id: criterion for criterion in criteria if criterion.value is not None}
    rows = [_row(reference, values[name], text) for name, text in reference.values.items() if name in values]
    if not rows:
        return None
    missing = [name for name in reference.values if name not in values]
    notes = [Reason.words(note) for note in reference.notes]
    if missing:
        notes.append(Reason.of("not-in-rms", criteria=missing))
    published = [row.published_error_percent for row in rows if row.published_error_percent is not None]
    if published:
        notes.append(Reason.of("published-rounded"))
    return Comparison(
        reference=reference.reference,
        title=reference.title,
        rms_error_percent=rms([row.error_percent for row in rows]),
        published_rms_error_percent=rms(published) if published else None,
        rows=rows,
        coded_notes=notes,
    )


def _row(reference: Reference, criterion: CriterionResult, text: str) -> ComparisonRow:
    where = f"reference {reference.reference}, {criterion.id}"
    test = in_unit(text, criterion.unit, where)
    printed = reference.published.get(criterion.id)
    published = None if printed is None else in_unit(printed, criterion.unit, where)
    simulation = criterion.value
    if simulation is None:
        raise UsageError(f"criterion {criterion.id} has no value to compare; leave it out of the reference")
    return ComparisonRow(
        channel=criterion.id,
        unit=criterion.unit,
        test=test,
        simulation=simulation,
        error_percent=error_percent(simulation, test),
        published=published,
        published_error_percent=None if published is None else whole_percent(error_percent(published, test)),
    )
