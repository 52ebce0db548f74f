"""The PDF certificate: PDF/A-3u by WeasyPrint, with its evidence attached, the same bytes every time.

The embedded result document says everything; the pages show it. Fonts and styles come from the templates'
folder alone: whatever else a document might ask for is refused, so nothing is fetched.
"""

from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from datetime import UTC, date, datetime, time
from typing import TYPE_CHECKING, Any, Literal

from certkit._version import __version__
from certkit.errors import RunError, UsageError
from certkit.reporting.attachments import Enclosure, enclosures, manifest
from certkit.reporting.templating import fill, folder, text
from certkit.reporting.view import View, unique_views

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.grading.result import Result

Paper = Literal["A4", "Letter"]

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
        dates = (result.laboratory or {}).get("dates")
        issued = dates.get("issued") if isinstance(dates, dict) else None
        if issued:
            try:
                return datetime.combine(date.fromisoformat(str(issued)[:10]), time(), UTC)
            except ValueError:
                continue
    return FIXED_DATE


def certificate(
    results: Sequence[Result], *, paper: Paper = "A4", title: str | None = None, contents: bool = False
) -> bytes:
    """Render one certificate, or several bound together.

    Parameters
    ----------
    results : sequence of Result
        One chapter each.
    paper : {'A4', 'Letter'}
        Page size.
    title : str, optional
        Title of a bound suite; of the first result otherwise.
    contents : bool
        Begin with a table of contents.

    Returns
    -------
    bytes
        The PDF.

    Raises
    ------
    RunError
        When WeasyPrint or the Pango library that it draws text with is missing; says how to install them.
    """
    weasyprint = _weasyprint()
    several = len(results) > 1
    views = unique_views(results)
    chapters = [
        Chapter(shown, enclosures(shown.result, f"{shown.key}-" if several else "")) for shown in views
    ]
    listed = manifest([part for chapter in chapters for part in chapter.enclosures], [r.id for r in results])
    created = creation_date(results)
    html = fill(
        "certificate.html.j2",
        title=title or results[0].title,
        version=__version__,
        created=created.strftime("%Y-%m-%dT%H:%M:%SZ"),
        style=text("styles/certificate.css"),
        paper=paper,
        chapters=chapters,
        contents=contents,
        manifest=listed,
    )
    attached = [
        weasyprint.Attachment(
            string=part.content,
            base_url=folder().as_uri(),
            name=part.name,
            description=f"{part.role}, SHA-256 {part.sha256}",
            created=created,
            modified=created,
            relationship=part.relationship,
        )
        for part in [*(part for chapter in chapters for part in chapter.enclosures), listed]
    ]
    document = weasyprint.HTML(
        string=html, base_url=folder().as_uri() + "/", url_fetcher=_fetcher(weasyprint)
    )
    with warnings.catch_warnings():
        # WeasyPrint leaves its colour profile's file to the garbage collector.
        warnings.simplefilter("ignore", ResourceWarning)
        pdf: bytes = document.write_pdf(
            pdf_variant="pdf/a-3u", attachments=attached, finisher=_finish, custom_metadata=False
        )
    return pdf


def _weasyprint() -> Any:  # noqa: ANN401  # the module has no types
    try:
        import weasyprint  # noqa: PLC0415  # 1.1 s that only a PDF needs
    except OSError as error:
        raise RunError(
            "the PDF needs the Pango library, which is not installed; on Debian and Ubuntu: "
            "`apt install libpango-1.0-0 libpangoft2-1.0-0 libharfbuzz0b`, on macOS: `brew install pango`; "
            "HTML and JSON do not need it (`--format html`)"
        ) from error
    return weasyprint


def _fetcher(weasyprint: Any) -> Any:  # noqa: ANN401  # likewise
    """Return a fetcher that hands out the fonts of our own folder and embedded pictures, and nothing else."""
    fonts = (folder() / "fonts").as_uri() + "/"

    class OwnFilesOnly(weasyprint.urls.URLFetcher):  # type: ignore[misc]  # the module has no types
        def fetch(self, url: str, headers: dict[str, str] | None = None) -> Any:  # noqa: ANN401  # likewise
            if url.startswith("data:image/") or (url.startswith(fonts) and ".." not in url):
                return super().fetch(url, headers)
            raise ValueError(f"a certificate fetches nothing: {url[:80]}")

    return OwnFilesOnly(allowed_protocols=("file", "data"))


def _finish(document: Any, pdf: Any) -> None:  # noqa: ANN401  # likewise
    """Label the pages 1, 2, 3 …, as printed, and name each attachment once: WeasyPrint 70 names it twice."""
    import pydyf  # noqa: PLC0415  # comes with WeasyPrint

    del document
    labels = pydyf.Dictionary({"Nums": pydyf.Array([0, pydyf.Dictionary({"S": "/D"})])})
    pdf.catalog["PageLabels"] = labels
    if "AF" in pdf.catalog:
        pdf.catalog["AF"] = pydyf.Array(dict.fromkeys(pdf.catalog["AF"]))


def pdf_of_drawing(drawing: str, width: float, height: float) -> bytes:
    """Return one of our SVG drawings as a page of exactly its size, set in the shipped font.

    Parameters
    ----------
    drawing : str
        SVG from `certkit.reporting.charts`.
    width, height : float
        Its size in CSS pixels.
    """
    weasyprint = _weasyprint()
    size = (
        f"@page {{ size: {width:g}px {height:g}px; margin: 0 }} body {{ margin: 0 }} svg {{ display: block }}"
    )
    faces = "".join(
        line for line in text("styles/certificate.css").splitlines() if line.startswith("@font-face")
    )
    html = f"<style>{faces} {size}</style>{drawing}"
    document = weasyprint.HTML(
        string=html, base_url=folder().as_uri() + "/", url_fetcher=_fetcher(weasyprint)
    )
    pdf: bytes = document.write_pdf()
    return pdf
