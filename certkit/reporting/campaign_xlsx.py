"""A campaign as a workbook (extra `xlsx`): points, schemes, sources, agreement, with native charts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.campaign_view import (
    CampaignView,
    car_score,
    criterion_shade,
    judged_words,
    point_shade,
)
from certkit.reporting.charts.car_front import SHADE
from certkit.reporting.euro_ncap_leg_sheet import HEADS, SCHEME, SHEET, leg_rows
from certkit.reporting.workbook import SheetBook, Tinted

if TYPE_CHECKING:
    from certkit.documents.campaign_report import CampaignReport, JudgedScheme
    from certkit.reporting.workbook import Cell


def campaign_xlsx(document: CampaignReport) -> bytes:
    """Return the workbook."""
    view = CampaignView(document)
    book = SheetBook(document.title, document)
    above = [document.title, f"{document.car.name}: {document.verdict}", f"Campaign {document.id}"]
    for scheme in document.schemes:
        score = car_score(scheme)
        above.append(f"{scheme.title}: {scheme.verdict or 'shown only'}{f', {score}' if score else ''}")
    above += document.remarks
    heads = ["point", "across [mm]", "source", *(head.text for head in view.criteria), *view.scheme_names]
    rows: list[list[Cell]] = []
    for row in view.points:
        values = {each.id: each for scheme in reversed(row.judged) for each in scheme.criteria}
        cells: list[Cell] = [
            Tinted(values[head.id].value, SHADE[criterion_shade(values[head.id])])
            if head.id in values
            else None
            for head in view.criteria
        ]
        judged: list[Cell] = [Tinted(judged_words(each), SHADE[point_shade(each)]) for each in row.judged]
        rows.append([row.name, row.point.across, row.source, *cells, *judged])
    book.table("Points", heads, rows, above=above)
    for name, scheme in zip(view.scheme_names, document.schemes, strict=True):
        _scheme(book, name, scheme, document)
        if scheme.scheme == SCHEME and (leg := leg_rows(document, scheme)):
            book.table(SHEET, HEADS, leg, number="0.00")
    _sources(book, document)
    if document.agreement:
        _agreement(book, document)
    files = [(i.role, i.path, i.sha256) for i in document.provenance.inputs]
    book.table("Inputs", ("what", "file", "SHA-256"), files)
    return book.content()


def _scheme(book: SheetBook, name: str, scheme: JudgedScheme, document: CampaignReport) -> None:
    """Write a scheme's points, each criterion in percent of its limit, with charts across the car."""
    ids = list(dict.fromkeys(each.id for row in scheme.points for each in row.criteria))
    places = {point.name: point.across for point in document.points}
    ordered = sorted(scheme.points, key=lambda row: places[row.point])
    heads = ["point", "across [mm]", *(f"{each} [% of limit]" for each in ids)]
    heads += ["basis", "of", "source", "worst", "verdict", "points", "maximum", "remark"]
    rows: list[list[Cell]] = []
    for row in ordered:
        percent = {each.id: each.percent for each in row.criteria}
        end: tuple[Cell, ...] = (
            row.basis,
            row.of,
            row.source,
            row.worst,
            row.verdict,
            row.points,
            row.maximum,
            row.reason,
        )
        rows.append([row.point, places[row.point], *(percent.get(each) for each in ids), *end])
    above = [scheme.title, *scheme.remarks, *scheme.sources]
    place = book.table(name, heads, rows, above=above, number="0.0##")
    below = place.head + place.count + 2
    if ids:
        columns = list(range(2, 2 + len(ids)))
        titles = ("impact point, across the car", "% of the limit")
        book.chart(
            "column", f"{scheme.title}: share of the limit", place, columns, titles=titles, at=(below, 0)
        )
    if scheme.kind == "points":
        drawn = [2 + len(ids) + 5]
        titles = ("impact point, across the car", "points")
        book.chart("column", f"{scheme.title}: points", place, drawn, titles=titles, at=(below + 19, 0))


def _sources(book: SheetBook, document: CampaignReport) -> None:
    heads = ("point", "source", "label", "decides", "replaced", "criterion", "value", "unit", "certificate")
    rows: list[list[Cell]] = [
        [
            *(point.name, source.kind, source.label),
            *("yes" if source.decides else "no", "yes" if source.replaced else "no"),
            *(value.id, value.value, value.unit, source.certificate, value.reason or source.reason),
        ]
        for point in document.points
        for source in point.sources
        for value in source.values
    ]
    book.table("Sources", (*heads, "remark"), rows)


def _agreement(book: SheetBook, document: CampaignReport) -> None:
    heads = (
        "what",
        "point",
        "criterion",
        "unit",
        "predicted by",
        "predicted",
        "measured",
        "error [%]",
        "within",
    )
    rows: list[list[Cell]] = []
    for row in document.agreement:
        within: Cell = Tinted("no", SHADE["s5"]) if row.within is False else "yes" if row.within else ""
        told = (f"{row.point} {row.criterion}", row.point, row.criterion, row.unit, row.kind)
        rows.append([*told, row.predicted, row.measured, row.error_percent, within])
    place = book.table("Agreement", heads, rows, number="0.0##")
    book.chart(
        "bar",
        "Measured against predicted",
        place,
        [7],
        titles=("", "error, %"),
        at=(1, len(heads) + 1),
    )
