"""Prediction against verification: what was predicted of a point, beside what was measured there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.campaign_report import AgreementRow

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

    from certkit.documents.campaign_report import PointReport, SourceReport


def agreement(
    points: Sequence[PointReport], criteria: Collection[str], tolerance: float | None
) -> list[AgreementRow]:
    """Compare each prediction of a point with the measurement that decides there.

    Parameters
    ----------
    points : sequence of PointReport
    criteria : collection of str
        Ids of the criteria that some scheme looks at.
    tolerance : float, optional
        Largest error that keeps, %, to either side.

    Returns
    -------
    list of AgreementRow
        Of every point that was measured and predicted; the error is (measured − predicted) / predicted. A
        prediction that a later one has replaced is left out.
    """
    found: list[AgreementRow] = []
    for point in points:
        measured = next((s for s in point.sources if s.kind == "measured" and s.decides and s.usable), None)
        if measured is None:
            continue
        for source in point.sources:
            if source.kind != "measured" and source.usable and not source.replaced:
                found += _rows(point.name, source, measured, criteria, tolerance)
    return found


def _rows(
    point: str,
    predicted: SourceReport,
    measured: SourceReport,
    criteria: Collection[str],
    tolerance: float | None,
) -> Iterator[AgreementRow]:
    real = {value.id: value for value in measured.values if value.value is not None}
    for value in predicted.values:
        other = real.get(value.id)
        if value.id not in criteria or not value.value or other is None or other.value is None:
            continue
        error = 100.0 * (other.value - value.value) / abs(value.value)
        yield AgreementRow(
            point=point,
            criterion=value.id,
            unit=value.unit,
            kind=predicted.kind,
            predicted=value.value,
            measured=other.value,
            error_percent=error,
            within=None if tolerance is None else abs(error) <= tolerance,
        )
