"""A campaign in plain text: a table of points × criteria, then a line for each scheme."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.campaign_view import CampaignView, car_score, judged_words
from certkit.reporting.number_format import SIGNS
from certkit.reporting.plaintext import aligned

if TYPE_CHECKING:
    from collections.abc import Iterator

    from certkit.documents.campaign_report import CampaignReport, JudgedScheme


def campaign_text(document: CampaignReport) -> str:
    """Return the campaign for a terminal."""
    view = CampaignView(document)
    heads = ["", "across", "source", *(head.text for head in view.criteria), *view.scheme_names]
    rows = [
        [
            point.name,
            f"{point.across} mm",
            point.source,
            *(cell.text for cell in point.cells),
            *(judged_words(judged) for judged in point.judged),
        ]
        for point in view.points
    ]
    right = (1, *range(3, 3 + len(view.criteria)))
    parts = [
        f"{document.title}  {SIGNS[document.verdict]} {document.verdict.upper()}  {document.id}",
        aligned(heads, rows, right=right),
        "\n".join(_scheme(scheme) for scheme in document.schemes),
    ]
    agreed = view.agreement_words
    lines = [*([agreed] if agreed else []), *(f"! {remark}" for remark in _remarks(document))]
    return "\n".join([*parts, *lines])


def _scheme(scheme: JudgedScheme) -> str:
    said = f"{SIGNS[scheme.verdict]} {scheme.verdict}" if scheme.verdict else "  shown only"
    words = [f"{said:<16}", scheme.title]
    score = car_score(scheme)
    if score:
        words.append(f"– {score}")
    if scheme.worst_point:
        row = next(row for row in scheme.points if row.point == scheme.worst_point)
        words.append(f"– worst point {scheme.worst_point}, {row.worst} at {row.percent or 0:.0f} %")
    return " ".join(words)


def _remarks(document: CampaignReport) -> Iterator[str]:
    yield from document.remarks
    seen: set[str] = set()
    for scheme in document.schemes:
        for remark in scheme.remarks:
            if remark not in seen:
                seen.add(remark)
                yield remark
