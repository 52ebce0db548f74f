"""A comparison as a workbook (extra `xlsx`): ratings, errors, and the curves of each channel."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.workbook import SheetBook

if TYPE_CHECKING:
    from certkit.documents.comparison import ComparisonDocument
    from certkit.reporting.workbook import Cell


def comparison_xlsx(document: ComparisonDocument) -> bytes:
    """Return the workbook."""
    book = SheetBook(document.title, document)
    heads = "channel,title,corridor,phase,magnitude,slope,overall,grade,causes,remark"
    rows: list[list[Cell]] = [
        [
            *(r.channel, r.title, r.corridor, r.phase, r.magnitude, r.slope, r.overall),
            *(r.grade, "; ".join(r.causes), r.reason),
        ]
        for r in document.ratings
    ]
    above = [document.title, f"Reference: {document.reference.label}; compared: {document.other.label}"]
    if document.rating is not None:
        above.append(f"Mean ISO/TS 18571 rating {document.rating:.3f}, {document.grade}")
    place = book.table("Ratings", heads.split(","), rows, above=[*above, *document.notes])
    if rows:
        below = place.head + place.count + 2
        book.chart("column", "Overall rating", place, [6], titles=("", "ISO/TS 18571"), at=(below, 0))
    if document.checks:
        asked = "asked for,channel,value,lower,upper,unit,verdict,remark"
        checks: list[list[Cell]] = [
            [c.title, c.channel, c.value, c.lower, c.upper, c.unit, c.verdict, c.reason]
            for c in document.checks
        ]
        book.table("Rule", asked.split(","), checks, above=[document.rule])
    if document.rows:
        errors = [(r.channel, r.unit, r.test, r.simulation, r.error_percent) for r in document.rows]
        said = (document.reference.label, document.other.label)
        place = book.table("Errors", ("channel", "unit", *said, "error [%]"), errors)
        book.chart("column", "Error, %", place, [4], titles=("", "%"), at=(1, 6))
    for overlay in document.overlays:
        unit = overlay.unit
        columns = ("time [ms]", f"{document.reference.label} [{unit}]", f"{document.other.label} [{unit}]")
        lines = (overlay.milliseconds, overlay.reference, overlay.other, overlay.difference)
        curves = list(zip(*lines, strict=True))
        place = book.table(
            f"Curve {overlay.channel}", (*columns, f"difference [{unit}]"), curves, number="0.####"
        )
        titles = ("time after contact, ms", unit)
        book.chart("line", f"{overlay.channel} {overlay.title}", place, [1, 2, 3], titles=titles, at=(1, 5))
    return book.content()
