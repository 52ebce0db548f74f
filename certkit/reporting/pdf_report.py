"""The PDF certificate: PDF/A-3a by WeasyPrint, with its evidence attached, the same bytes every time.

The embedded result document says everything; the pages show it.
"""

from __future__ import annotations

import contextlib
import os
from dataclasses import dataclass
from datetime import UTC, date, datetime, time
from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.errors import UsageError
from certkit.reporting.attachments import Enclosure, enclosures, manifest
from certkit.reporting.font_check import check_font
from certkit.reporting.pdf_engine import typeset, weasyprint
from certkit.reporting.suite_head import suite_head
from certkit.reporting.templating import fill, text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result
    from certkit.reporting.report_format import Paper
    from certkit.reporting.result_view import View

FILE = "report.pdf"
SUITE_FILE: str | None = "suite.pdf"
TRANSLATED = True
REPEATABLE = False  # `verify` compares pages with what is attached to the PDF

FIXED_DATE = datetime(1980, 1, 1, tzinfo=UTC)
"""Date written into a PDF when nobody gave one: the bytes must not depend on the clock."""


@dataclass(frozen=True)
class Chapter:
    """One certificate inside the PDF, with the files it carries."""

    view: View
    enclosures: list[Enclosure]


def creation_date(results: Sequence[Result]) -> datetime:
    """Return the date that the PDF bears.

    `SOURCE_DATE_EPOCH` first, then the day a laboratory says it issued the certificate, else a fixed date.

    Raises
    ------
    UsageError
        When `SOURCE_DATE_EPOCH` is not a number of seconds.
    """
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")
    if epoch:
        try:
            return datetime.fromtimestamp(int(epoch), UTC)
        except (ValueError, OverflowError, OSError) as error:
            raise UsageError(
                f"SOURCE_DATE_EPOCH is `{epoch}`; it takes a number of seconds since 1970"
            ) from error
    for result in results:
        for section in (result.laboratory or {}).values():
            issued = section.get("issued") if isinstance(section, dict) else None
            with contextlib.suppress(ValueError):
                if issued:
                    return datetime.combine(date.fromisoformat(str(issued)[:10]), time(), UTC)
    return FIXED_DATE


def certificate(
    views: Sequence[View],
    *,
    paper: Paper = "A4",
    title: str | None = None,
    contents: bool = False,
    created: datetime | None = None,
) -> bytes:
    """Render one certificate, or several bound together.

    Parameters
    ----------
    views : sequence of View
        Results in the language of the pages, one chapter each; the documents inside stay as they are.
    paper : {'A4', 'Letter'}
        Page size.
    title : str, optional
        Title of a bound suite; of the first result otherwise.
    contents : bool
        Begin with a table of contents.
    created : datetime, optional
        Date that the PDF bears; see `creation_date` for where it comes from otherwise.

    Returns
    -------
    bytes
        The PDF.

    Raises
    ------
    MissingPartError
        When the Pango library that text is drawn with, or a font with the language's signs, is missing; says
        how to install it.
    """
    weasyprint()  # a missing library or font is said before any work is done
    spoken = views[0].spoken.code
    check_font(spoken)
    several = len(views) > 1
    results = [shown.document for shown in views]
    chapters = [
        Chapter(shown, enclosures(shown.document, f"{shown.key}-" if several else "")) for shown in views
    ]
    parts = [part for chapter in chapters for part in chapter.enclosures]
    listed = manifest(parts, [r.id for r in results], spoken, title)
    created = created or creation_date(results)
    html = fill(
        "certificate.html.j2",
        spoken=spoken,
        title=title or views[0].result.title,
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        paper=paper,
        chapters=chapters,
        contents=contents,
        suite=suite_head(views) if contents else None,
        manifest=listed,
    )
    return typeset(html, [*parts, listed], created)


def write(views: Sequence[View], *, title: str | None, paper: Paper) -> bytes:
    """Return the PDF of one result, or of a suite with its contents where there is a title."""
    return certificate(views, paper=paper, title=title, contents=title is not None)
