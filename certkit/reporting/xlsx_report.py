"""A result as a workbook (extra `xlsx`): criteria, curves with native charts, conditions, scores, inputs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.unverified import is_marked
from certkit.reporting.workbook import SheetBook

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Histories, Result
    from certkit.reporting.result_view import View
    from certkit.reporting.workbook import Cell

FILE = "report.xlsx"
SUITE_FILE: str | None = "suite.xlsx"
TRANSLATED = False
REPEATABLE = False  # its bytes depend on the version of XlsxWriter too

MOST_CHARTS = 4


def write(views: Sequence[View], *, title: str | None, paper: str) -> bytes:
    """Return the workbook of one result, or of a suite."""
    del paper
    marked = next((view.document for view in views if is_marked(view.document)), None)
    book = SheetBook(title or views[0].result.title, marked)
    if title is not None:
        heads = ("procedure", "title", "verdict", "criteria", "certificate")
        rows = [(v.result.procedure, v.result.title, v.result.verdict, v.tally, v.result.id) for v in views]
        book.table("Suite", heads, rows, above=[title])
    for view in views:
        _result(book, view.result, f"{view.result.procedure} " if title is not None else "")
    return book.content()


def _result(book: SheetBook, result: Result, before: str) -> None:
    heads = "criterion,title,value,unit,lower,upper,margin,time [ms],verdict,graded,confidence,source,remark"
    rows: list[list[Cell]] = [
        [
            *(c.id, c.title, c.value, c.unit, c.lower, c.upper, c.margin),
            None if c.time is None else c.time * 1e3,
            *(c.verdict if c.graded else "shown only", "yes" if c.graded else "no"),
            *(c.confidence, c.source, c.reason or c.note),
        ]
        for c in result.criteria
    ]
    above = [result.title, f"{result.kind}: {result.verdict}", f"Certificate {result.id}", *result.remarks]
    book.table(f"{before}Criteria", heads.split(","), rows, above=above)
    if result.scores:
        scores = [
            (s.id, s.points, s.maximum, s.criterion, s.value, s.unit, s.full, s.zero, s.confidence, s.source)
            for s in result.scores
        ]
        score_heads = ("score", "points", "maximum", "decided by", "value", "unit", "full below", "none from")
        book.table(f"{before}Scores", (*score_heads, "confidence", "source"), scores)
    if result.curves is not None:
        curves_sheet(book, f"{before}Curves", result.curves)
    if result.preconditions:
        conditions = [
            (p.quantity, p.value, p.unit, p.lower, p.upper, p.verdict) for p in result.preconditions
        ]
        book.table(
            f"{before}Conditions", ("condition", "value", "unit", "lower", "upper", "verdict"), conditions
        )
    files = [(i.role, i.path, i.sha256) for i in result.provenance.inputs]
    book.table(f"{before}Inputs", ("what", "file", "SHA-256"), files)


def curves_sheet(book: SheetBook, name: str, curves: Histories) -> None:
    """Write channels over time, with a chart a unit."""
    heads = ["time [ms]", *(f"{key} [{series.unit}]" for key, series in curves.series.items())]
    columns = [series.values for series in curves.series.values()]
    times = curves.milliseconds
    rows = [[times[i], *(values[i] for values in columns)] for i in range(curves.count)]
    place = book.table(name, heads, rows, number="0.####")
    units: dict[str, list[int]] = {}
    for column, series in enumerate(curves.series.values(), 1):
        units.setdefault(series.unit, []).append(column)
    for index, (unit, drawn) in enumerate(list(units.items())[:MOST_CHARTS]):
        book.chart(
            "line",
            f"Channels in {unit}",
            place,
            drawn,
            titles=("time after contact, ms", unit),
            at=(1 + 20 * index, len(heads) + 1),
        )
