"""A campaign as slides (extra `pptx`): verdict, points, and native charts across the car."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.campaign_view import (
    CampaignView,
    car_score,
    criterion_shade,
    judged_words,
    point_shade,
    short_name,
)
from certkit.reporting.car_slide import car_slide
from certkit.reporting.charts.car_front import SHADE
from certkit.reporting.number_format import shown
from certkit.reporting.slide_deck import SlideDeck
from certkit.reporting.workbook import Tinted

if TYPE_CHECKING:
    from certkit.documents.campaign_report import CampaignReport, JudgedScheme
    from certkit.reporting.workbook import Cell


def campaign_pptx(document: CampaignReport) -> bytes:
    """Return the slides."""
    view = CampaignView(document)
    deck = SlideDeck(document)
    lines = [f"{document.verdict.upper()}: {view.meaning}"]
    for scheme in document.schemes:
        worst = (
            f"; worst point {scheme.worst_point}, {view.worst_words(scheme)}" if scheme.worst_point else ""
        )
        score = car_score(scheme) or view.headline(scheme)
        lines.append(f"{scheme.title}: {score}{worst}")
    agreed = [view.agreement_words] if view.agreement_words else []
    deck.title(document.title, [*lines, *agreed, *document.remarks, f"Campaign {document.id}"])
    car_slide(deck, document, document.schemes[0])
    deck.table(f"{document.title}: points", *_points(view))
    for scheme in document.schemes:
        _scheme(deck, scheme, document)
    if document.agreement:
        names = [f"{row.point} {row.criterion}" for row in document.agreement]
        errors = {"error": [row.error_percent for row in document.agreement]}
        deck.columns("Measured against predicted", names, errors, "error, %")
    return deck.content()


def _points(view: CampaignView) -> tuple[list[str], list[list[Cell]]]:
    heads = ["point", "mm", "source", *(head.text for head in view.criteria), *view.scheme_names]
    rows: list[list[Cell]] = []
    for row in view.points:
        values = {each.id: each for scheme in reversed(row.judged) for each in scheme.criteria}
        cells: list[Cell] = []
        for head in view.criteria:
            each = values.get(head.id)
            cells.append(Tinted(shown(each.value, each.unit), SHADE[criterion_shade(each)]) if each else None)
        judged: list[Cell] = [Tinted(judged_words(each), SHADE[point_shade(each)]) for each in row.judged]
        rows.append([row.name, row.across, row.source, *cells, *judged])
    return heads, rows


def _scheme(deck: SlideDeck, scheme: JudgedScheme, document: CampaignReport) -> None:
    places = {point.name: point.across for point in document.points}
    rows = sorted(scheme.points, key=lambda row: places[row.point])
    names = [row.point for row in rows]
    if scheme.kind == "points":
        points = {"points": [row.points for row in rows]}
        deck.columns(
            f"{scheme.title}: {car_score(scheme) or 'points'}", names, points, "points of each impact point"
        )
        return
    ids = list(dict.fromkeys(each.id for row in rows for each in row.criteria))
    found = [{each.id: each.percent for each in row.criteria} for row in rows]
    shares = {name: [percent.get(name) for percent in found] for name in ids}
    deck.columns(f"{scheme.title} ({short_name(scheme)})", names, shares, "% of the limit")
