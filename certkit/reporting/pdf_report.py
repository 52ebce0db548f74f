"""The PDF certificate: PDF/A-3a by WeasyPrint, with its evidence attached, the same bytes every time.

The embedded result document says everything; the pages show it.
"""

from __future__ import annotations

import contextlib
import os
from datetime import UTC, date, datetime, time
from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.errors import UsageError
from certkit.reporting.attachments import Enclosure, enclosures, manifest
from certkit.reporting.font_check import check_font
from certkit.reporting.pdf_engine import typeset, weasyprint
from certkit.reporting.suite_head import suite_head
from certkit.reporting.suite_pdf import LINK_SCHEME, attached_files, bind
from certkit.reporting.templating import fill, text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Result
    from certkit.reporting.report_formats import Paper
    from certkit.reporting.result_view import View

FILE = "report.pdf"
SUITE_FILE: str | None = "suite.pdf"
TRANSLATED = True
REPEATABLE = False  # `verify` compares pages with what is attached to the PDF

FIXED_DATE = datetime(1980, 1, 1, tzinfo=UTC)
"""Date written into a PDF when nobody gave one: the bytes must not depend on the clock."""


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
    created: datetime | None = None,
) -> bytes:
    """Render one certificate, or several bound together.

    Parameters
    ----------
    views : sequence of View
        Results in the language of the pages; the documents inside stay as they are. Those of a suite may have
        their PDF with them, which is not set again then.
    paper : {'A4', 'Letter'}
        Page size.
    title : str, optional
        Of a suite, which begins with its contents; without it there is a single result.
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
    check_font(views[0].spoken.code)
    created = created or creation_date([shown.document for shown in views])
    return _single(views[0], paper, created) if title is None else _suite(views, paper, title, created)


def _single(view: View, paper: Paper, created: datetime) -> bytes:
    """Set the certificate of one result."""
    parts = enclosures(view.document)
    listed = manifest(parts, [view.document.id], view.spoken.code)
    html = _filled(
        "certificate.html.j2",
        view.spoken.code,
        paper,
        created,
        title=view.result.title,
        view=view,
        enclosures=parts,
        manifest=listed,
    )
    return typeset(html, [*parts, listed], created, key=view.document.id)


def _suite(views: Sequence[View], paper: Paper, title: str, created: datetime) -> bytes:
    """Bind certificates behind a page of contents."""
    spoken = views[0].spoken.code
    bound = {view.key: view.pdf or _single(view, paper, creation_date([view.document])) for view in views}
    counts, parts = [], []
    for key, pdf in bound.items():
        count, files = attached_files(pdf)
        counts.append(count)
        parts += [
            Enclosure(f"{key}-{name}", *role_and_content, "Data") for name, role_and_content in files.items()
        ]
    listed = manifest(parts, [view.document.id for view in views], spoken, title)

    def contents(first: int) -> bytes:
        pages = [first + sum(counts[:number]) for number in range(len(counts))]
        html = _filled(
            "suite.html.j2",
            spoken,
            paper,
            created,
            title=title,
            views=views,
            suite=suite_head(views),
            pages=pages,
            scheme=LINK_SCHEME,
        )
        return typeset(html, [listed], created, key="contents")

    # Where the first certificate begins depends on how long the contents are, and that hardly ever on where.
    made = contents(2)
    length, _ = attached_files(made)
    return bind(made if length == 1 else contents(1 + length), bound, created)


def _filled(template: str, spoken: str, paper: Paper, created: datetime, **values: object) -> str:
    """Fill a template of printed pages."""
    return fill(
        template,
        spoken=spoken,
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        paper=paper,
        **values,
    )


def write(views: Sequence[View], *, title: str | None, paper: Paper) -> bytes:
    """Return the PDF of one result, or of a suite with its contents where there is a title."""
    return certificate(views, paper=paper, title=title)
