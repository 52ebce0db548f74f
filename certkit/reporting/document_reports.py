"""The reports of each kind of document: which formats there are, and what renders them.

A new kind is one entry here; the function takes the document, a folder and formats, and returns the files
it wrote.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from certkit.errors import UsageError
from certkit.reporting.language import ENGLISH
from certkit.reporting.report_format import FORMATS

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from certkit.documents.output_document import OutputDocument
    from certkit.reporting.report_format import Paper


@dataclass(frozen=True)
class DocumentReport:
    """How one kind of document is rendered.

    Parameters
    ----------
    writer : str
        `module:function`, imported when it is needed.
    formats : tuple of str
        All formats that there are.
    usual : tuple of str
        Those written when none is named.
    takes_paper : bool
        Whether the writer is told the page size beside the language.
    """

    writer: str
    formats: tuple[str, ...] = ("html",)
    usual: tuple[str, ...] = ("html",)
    takes_paper: bool = False


_PAPER = ("html", "pdf")
_OFFICE = ("xlsx", "pptx")

REPORTS = {
    "certkit-result/1": DocumentReport(
        "certkit.reporting.writing:render",
        tuple(FORMATS),
        _PAPER,
        takes_paper=True,
    ),
    "certkit-comparison/1": DocumentReport(
        "certkit.reporting.comparison_report:render_comparison", (*_PAPER, *_OFFICE)
    ),
    "certkit-extraction/1": DocumentReport(
        "certkit.reporting.extraction_report:render_extraction", _PAPER, _PAPER
    ),
    "certkit-campaign/1": DocumentReport(
        "certkit.reporting.campaign_files:render_campaign", ("html", "csv", "junit", *_OFFICE)
    ),
    "certkit-study/1": DocumentReport("certkit.reporting.study_pages:render_study"),
    "certkit-optimum/1": DocumentReport("certkit.reporting.study_pages:render_optimum"),
    "certkit-fit/1": DocumentReport("certkit.reporting.study_pages:render_calibration"),
    "certkit-certificate/1": DocumentReport(
        "certkit.reporting.legform_certificate_report:render_certificate", _PAPER, _PAPER, takes_paper=True
    ),
    "certkit-logbook/1": DocumentReport("certkit.reporting.logbook_page:render_logbook"),
    "certkit-uncertainty/1": DocumentReport("certkit.reporting.uncertainty_page:render_uncertainty"),
    "certkit-twin/1": DocumentReport("certkit.reporting.twin_page:render_twin"),
    "certkit-round-robin/1": DocumentReport("certkit.reporting.round_robin_page:render_round_robin"),
}


def render_document(
    document: OutputDocument,
    out: Path,
    formats: Sequence[str] | None = None,
    *,
    paper: Paper = "A4",
    spoken: str = ENGLISH,
) -> list[Path]:
    """Write the reports of a document of any kind into a folder.

    Parameters
    ----------
    document : OutputDocument
        With the digits of its file (`as_written`); nothing else is read.
    out : Path
        Folder; made when missing.
    formats : sequence of str, optional
        The kind's usual ones when missing.
    paper : {'A4', 'Letter'}
        Page size of the PDF, where there is a choice.
    spoken : str
        Language of pages and PDFs.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    UsageError
        When this kind has no such format.
    """
    report = REPORTS[document.schema_word()]
    checked(document, formats or ())
    module, _, name = report.writer.partition(":")
    write = getattr(import_module(module), name)
    options = {"spoken": spoken}
    if report.takes_paper:
        options["paper"] = paper
    found: list[Path] = write(document, out, report.usual if formats is None else formats, **options)
    return found


def checked(document: OutputDocument | type[OutputDocument], formats: Sequence[str]) -> list[str]:
    """Return the formats, if a document, or one of this kind, has each of them.

    Raises
    ------
    UsageError
        When it has not.
    """
    report = REPORTS[document.schema_word()]
    unknown = sorted(set(formats) - set(report.formats) - {"json"})
    if unknown:
        raise UsageError(
            f"there is no {document.noun} in the format `{unknown[0]}`; use {', '.join(report.formats)}"
        )
    return list(formats)
