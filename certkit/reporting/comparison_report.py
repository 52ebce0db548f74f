"""Comparisons as a page and as PDF, from the comparison document alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from certkit._version import __version__
from certkit.reporting import number_format as words
from certkit.reporting.charts.lines import lines_chart
from certkit.reporting.language import ENGLISH, language, worded
from certkit.reporting.static_page import static_page
from certkit.reporting.templating import fill, text
from certkit.reporting.translated_titles import title_in

if TYPE_CHECKING:
    from certkit.documents.comparison import ComparisonDocument, Overlay
    from certkit.reporting.language import Language
    from certkit.reporting.svg import Drawing


COMPARED = "{other} compared with {reference}"


def comparison_page(document: ComparisonDocument, spoken: str = ENGLISH) -> str:
    """Return the page."""
    return static_page(
        "comparison.html.j2", _title(document, spoken), spoken=spoken, **_shown(document, spoken)
    )


def comparison_pdf(document: ComparisonDocument, spoken: str = ENGLISH) -> bytes:
    """Return the PDF, with the comparison document attached."""
    from certkit.reporting.attachments import Enclosure  # noqa: PLC0415  # only a PDF needs these
    from certkit.reporting.font_check import check_font  # noqa: PLC0415  # likewise
    from certkit.reporting.pdf_engine import typeset, weasyprint  # noqa: PLC0415  # likewise
    from certkit.reporting.pdf_report import creation_date  # noqa: PLC0415  # likewise

    weasyprint()
    check_font(spoken)
    created = creation_date([])
    html = fill(
        "comparison-pdf.html.j2",
        spoken=spoken,
        title=_title(document, spoken),
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        **_shown(document, spoken),
    )
    enclosed = Enclosure("comparison.json", "comparison", document.to_json().encode(), "Data")
    return typeset(html, [enclosed], created)


def _title(document: ComparisonDocument, spoken: str) -> str:
    """Return the title in a language: what is compared with what."""
    sides = {"other": document.other.label, "reference": document.reference.label}
    return document.title if spoken == ENGLISH else language(spoken).word(COMPARED, **sides)


def _shown(document: ComparisonDocument, spoken: str) -> dict[str, Any]:
    """Return what page and PDF show."""
    shown = worded(document, spoken) if spoken != ENGLISH else document
    return {
        "doc": shown,
        "said": _in_short(shown, language(spoken)),
        "drawings": [_overlay(overlay, document, language(spoken)) for overlay in document.overlays],
    }


def _in_short(document: ComparisonDocument, spoken: Language) -> list[str]:
    """Say how far the tests are apart: by the rule, by their peaks, by the rating, with the worst channel."""
    t, said = spoken.word, []
    if document.verdict:
        said.append(f"{spoken.verdict(document.verdict)}: {title_in(document.rule, spoken)}")
    if document.rows:
        worst = max(document.rows, key=lambda row: abs(row.error_percent))
        said.append(
            t(
                "Peaks: {percent} % root mean square, farthest {channel} with {error} %.",
                percent=words.fixed(document.rms_error_percent, 1),
                channel=worst.channel,
                error=words.signed(worst.error_percent, 1),
            )
        )
    rated = [row for row in document.ratings if row.overall is not None]
    if document.rating is not None and rated:
        least = min(rated, key=lambda row: row.overall or 0.0)
        said.append(
            t(
                "ISO/TS 18571: {rating}, {grade}; lowest {channel} with {least}.",
                rating=words.fixed(document.rating, 2),
                grade=t(document.grade),
                channel=least.channel,
                least=words.fixed(least.overall, 2),
            )
        )
    return said


def _overlay(overlay: Overlay, document: ComparisonDocument, spoken: Language) -> Drawing:
    """Draw both curves and their difference."""
    times = overlay.milliseconds
    lines = [
        (document.reference.label, times, overlay.reference),
        (document.other.label, times, overlay.other),
        (spoken.word("difference"), times, overlay.difference),
    ]
    filtered = "" if overlay.filter == "none" else f", {overlay.filter}"
    title = f"{words.named(overlay.channel, title_in(overlay.title, spoken))}{filtered}"
    return lines_chart(lines, title, spoken.word("time after contact, ms"), overlay.unit, most=240)
