"""The certificate of a legform as a page, on paper and as text, from the certificate document alone."""

from __future__ import annotations

from datetime import UTC, date, datetime, time
from typing import TYPE_CHECKING, Any

from certkit._version import __version__
from certkit.documents.legform_certificate import LOGBOOK
from certkit.reporting.attachments import Enclosure, manifest
from certkit.reporting.laboratory_view import laboratory_view
from certkit.reporting.language import ENGLISH, language, worded
from certkit.reporting.logbook_page import logbook_page
from certkit.reporting.number_format import SIGNS
from certkit.reporting.plaintext import aligned
from certkit.reporting.result_view import unique_views
from certkit.reporting.static_page import static_page

if TYPE_CHECKING:
    from certkit.documents.legform_certificate import LegformCertificate
    from certkit.reporting.report_formats import Paper

PAGE = "certificate.html"


def certificate_page(document: LegformCertificate, spoken: str = ENGLISH) -> str:
    """Return the page."""
    title = language(spoken).word("Certificate of legform {serial}", serial=document.serial)
    return static_page("legform-certificate.html.j2", title, spoken=spoken, **_shown(document, spoken))


def certificate_pdf(
    document: LegformCertificate,
    *,
    paper: Paper = "A4",
    spoken: str = ENGLISH,
    created: datetime | None = None,
) -> bytes:
    """Return the certificate as PDF/A-3a, with the document and the logbook attached."""
    from certkit.reporting.font_check import check_font  # noqa: PLC0415  # only for a PDF
    from certkit.reporting.pdf_engine import typeset, weasyprint  # noqa: PLC0415  # likewise
    from certkit.reporting.templating import fill, text  # noqa: PLC0415  # likewise

    weasyprint()
    check_font(spoken)
    created = created or datetime.combine(date.fromisoformat(document.day), time(), UTC)
    parts = [
        Enclosure(document.file_name, document.noun, document.to_json().encode(), "Data"),
        Enclosure(
            LOGBOOK,  # with its curves, as one file
            "logbook with its curves",
            logbook_page([document.logbook], spoken).encode(),
            "Supplement",
        ),
    ]
    listed = manifest(parts, [document.id], spoken)
    kind = language(spoken).word("Legform certificate")
    html = fill(
        "legform-certificate-pdf.html.j2",
        spoken=spoken,
        title=f"{kind} {document.number or document.id} – {document.serial}",
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        paper=paper,
        enclosures=[*parts, listed],
        **_shown(document, spoken),
    )
    return typeset(html, [*parts, listed], created, key=document.id)


def _shown(document: LegformCertificate, spoken: str) -> dict[str, Any]:
    """Return what both templates show."""
    shown = worded(document, spoken) if spoken != ENGLISH else document
    views = {view.result.procedure: view for view in unique_views(document.results, spoken)}
    return {
        "doc": shown,
        "lab": laboratory_view(shown.laboratory, language(spoken).word),
        "tests": [(test, views.get(test.procedure)) for test in shown.tests],
    }


def certificate_text(document: LegformCertificate) -> str:
    """Return the certificate for a terminal: verdict, tests, what stands against it."""
    number = f"{document.number}, " if document.number else ""
    verdict = f"{SIGNS[document.verdict]} {document.verdict.upper()}"
    rows = [
        (test.procedure, test.day or "missing", test.number or "–", test.id or "–", test.verdict)
        for test in document.tests
    ]
    heads = ("test", "day", "report", "id", "verdict")
    due = f"next due: {document.next_due or 'no day is known'} ({document.rules})"
    return "\n".join(
        (
            f"Legform {document.serial}, certificate {number}{document.id} of {document.day}  {verdict}",
            aligned(heads, rows),
            *(f"! {remark}" for remark in document.remarks),
            due,
        )
    )
