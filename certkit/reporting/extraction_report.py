"""Extraction of a vehicle from finite-element histories, as a page and as PDF, from its document alone.

First what the self-checks show: run and model in motion (the paper's Fig. 22), the worst group, the leg's
channels (23), the load paths. Then the five steps: momentum (17), force between groups (18), force over
shortening (19), and the stress–strain curve beside the material's own (20).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.reporting.attachments import Enclosure
from certkit.reporting.coupled_check import worst_group
from certkit.reporting.extraction_data import extraction_payload
from certkit.reporting.extraction_view import extraction_view
from certkit.reporting.html_report import SCRIPTS
from certkit.reporting.language import ENGLISH, language
from certkit.reporting.page_data import embedded
from certkit.reporting.pdf_engine import typeset
from certkit.reporting.pdf_report import creation_date
from certkit.reporting.static_page import static_page
from certkit.reporting.templating import fill, text

if TYPE_CHECKING:
    from certkit.identification import ExtractionResult


def extraction_page(result: ExtractionResult, spoken: str = ENGLISH) -> str:
    """Return the page."""
    data = extraction_payload(result, worst_group(result), language(spoken).word)
    return static_page(
        "extraction.html.j2",
        result.title,
        spoken=spoken,
        scripts=SCRIPTS if data else (),
        data=embedded(data) if data else None,
        doc=result,
        view=extraction_view(result, spoken),
    )


def extraction_pdf(result: ExtractionResult, spoken: str = ENGLISH) -> bytes:
    """Return the PDF, with the result document attached."""
    created = creation_date([])
    html = fill(
        "extraction-pdf.html.j2",
        spoken=spoken,
        title=result.title,
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        doc=result,
        view=extraction_view(result, spoken),
    )
    enclosed = Enclosure("extraction.json", "extraction result", result.to_json().encode(), "Data")
    return typeset(html, [enclosed], created)
