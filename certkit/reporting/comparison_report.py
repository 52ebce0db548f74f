"""Comparisons as a page and as PDF, from the comparison document alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.reporting import number_format as words
from certkit.reporting.charts.lines import lines_chart
from certkit.reporting.named_files import Files, write_named
from certkit.reporting.static_page import static_page
from certkit.reporting.templating import fill, text

if TYPE_CHECKING:
    from collections.abc import Collection
    from pathlib import Path

    from certkit.documents.comparison import ComparisonDocument, Overlay
    from certkit.reporting.svg import Drawing


COMPARISON_FILES: Files = {
    "xlsx": ("comparison.xlsx", "certkit.reporting.comparison_xlsx:comparison_xlsx"),
    "pptx": ("comparison.pptx", "certkit.reporting.comparison_pptx:comparison_pptx"),
    "html": ("comparison.html", "certkit.reporting.comparison_report:comparison_page"),
    "pdf": ("comparison.pdf", "certkit.reporting.comparison_report:comparison_pdf"),
}


def render_comparison(document: ComparisonDocument, out: Path, formats: Collection[str]) -> list[Path]:
    """Write the wanted reports, and return what was written."""
    return write_named(document, out, formats, COMPARISON_FILES)


def comparison_page(document: ComparisonDocument) -> str:
    """Return the page."""
    drawings = [_overlay(overlay, document) for overlay in document.overlays]
    return static_page("comparison.html.j2", document.title, doc=document, drawings=drawings)


def comparison_pdf(document: ComparisonDocument) -> bytes:
    """Return the PDF, with the comparison document attached."""
    from certkit.reporting.attachments import Enclosure  # noqa: PLC0415  # only a PDF needs these
    from certkit.reporting.pdf_engine import typeset  # noqa: PLC0415  # likewise
    from certkit.reporting.pdf_report import creation_date  # noqa: PLC0415  # likewise

    created = creation_date([])
    html = fill(
        "comparison-pdf.html.j2",
        title=document.title,
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        doc=document,
        drawings=[_overlay(overlay, document) for overlay in document.overlays],
    )
    enclosed = Enclosure("comparison.json", "comparison", document.to_json().encode(), "Data")
    return typeset(html, [enclosed], created)


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
