"""Comparisons as a page and as text, from the comparison document alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import number_format as words
from certkit.reporting.charts.lines import lines_chart
from certkit.reporting.named_files import Files, write_named
from certkit.reporting.plaintext import aligned
from certkit.reporting.static_page import static_page

if TYPE_CHECKING:
    from collections.abc import Collection
    from pathlib import Path

    from certkit.documents.comparison import ComparisonDocument, Overlay
    from certkit.reporting.svg import Drawing


COMPARISON_FILES: Files = {
    "xlsx": ("comparison.xlsx", "certkit.reporting.comparison_xlsx:comparison_xlsx"),
    "pptx": ("comparison.pptx", "certkit.reporting.comparison_pptx:comparison_pptx"),
    "html": ("comparison.html", "certkit.reporting.comparison_report:comparison_page"),
}


def render_comparison(document: ComparisonDocument, out: Path, formats: Collection[str]) -> list[Path]:
    """Write the wanted reports, and return what was written."""
    return write_named(document, out, formats, COMPARISON_FILES)


def comparison_page(document: ComparisonDocument) -> str:
    """Return the page."""
    drawings = [_overlay(overlay, document) for overlay in document.overlays]
    return static_page("comparison.html.j2", document.title, doc=document, drawings=drawings)


def _overlay(overlay: Overlay, document: ComparisonDocument) -> Drawing:
    """Draw both curves and their difference."""
    count = len(overlay.reference)
    times = [(overlay.start + i * overlay.interval) * 1e3 for i in range(count)]
    lines = [
        (document.reference.label, times, overlay.reference),
        (document.other.label, times, overlay.other),
        ("difference", times, overlay.difference),
    ]
    filtered = "" if overlay.filter == "none" else f", {overlay.filter}"
    title = f"{words.named(overlay.channel, overlay.title)}{filtered}"
    return lines_chart(lines, title, "time after contact, ms", overlay.unit)


def comparison_text(document: ComparisonDocument) -> str:
    """Return the comparison for a terminal: error table and ratings."""
    parts = [document.title]
    if document.rows:
        rows = [
            (
                row.channel,
                words.shown(row.test, row.unit),
                words.shown(row.simulation, row.unit),
                row.unit,
                f"{words.fixed(row.error_percent, 1)} %",
            )
            for row in document.rows
        ]
        heads = ("channel", document.reference.label, document.other.label, "unit", "error")
        parts.append(aligned(heads, rows, right=(1, 2, 4)))
        parts.append(f"rms error {words.fixed(document.rms_error_percent, 1)} %")
    ratings = [
        (
            rating.channel,
            *(words.fixed(v, 2) for v in (rating.corridor, rating.phase, rating.magnitude, rating.slope)),
            words.fixed(rating.overall, 2),
            rating.grade or f"not rated: {rating.reason}",
        )
        for rating in document.ratings
    ]
    parts_of_rating = ("ISO/TS 18571", "corridor", "phase", "magnitude", "slope", "overall", "grade")
    parts.append(aligned(parts_of_rating, ratings, right=(1, 2, 3, 4, 5)))
    if document.rating is not None:
        parts.append(f"mean rating {words.fixed(document.rating, 2)}, {document.grade}")
    parts += [f"note: {note}" for note in document.notes]
    return "\n\n".join(parts[:-1]) + "\n" + parts[-1] if len(parts) > 1 else parts[0]
