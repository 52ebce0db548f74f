"""The reports of each kind of document: which formats there are, and what renders them.

A new kind is one entry here: the file of each format, and the function that makes its content of the document
(and the language, where people read it). A kind whose files are not one each names a writer instead, which
takes the document, a folder and formats, and returns the files it wrote.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, NamedTuple

from certkit.errors import UsageError
from certkit.reporting.language_list import ENGLISH
from certkit.reporting.report_formats import FORMATS, report_format

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from certkit.documents.output_document import OutputDocument
    from certkit.reporting.report_formats import Paper
    from certkit.reporting.result_view import View


class DocumentReport(NamedTuple):
    """How one kind of document is rendered.

    Parameters
    ----------
    formats : mapping of str to (str, str)
        All formats that there are: the file of each, and `module:function`, imported when it is needed, that
        makes its content. Empty texts where the writer knows.
    usual : tuple of str
        Those written when none is named.
    takes_paper : bool
        Whether the PDF's function, or the writer, is told the page size beside the language.
    writer : str
        `module:function` that writes all of them.
    """

    formats: Mapping[str, tuple[str, str]]
    usual: tuple[str, ...] = ("html",)
    takes_paper: bool = False
    writer: str = ""


def _files(name: str, **made_by: str) -> dict[str, tuple[str, str]]:
    """Return the file of each format, all of one name, and what makes it: `module:function`."""
    return {each: (f"{name}.{each}", f"certkit.reporting.{place}") for each, place in made_by.items()}


_PAPER = ("html", "pdf")

REPORTS = {
    "certkit-result/1": DocumentReport(
        dict.fromkeys(FORMATS, ("", "")), _PAPER, takes_paper=True, writer="certkit.reporting.writing:render"
    ),
    "certkit-comparison/1": DocumentReport(
        _files(
            "comparison",
            html="comparison_report:comparison_page",
            pdf="comparison_report:comparison_pdf",
            xlsx="comparison_xlsx:comparison_xlsx",
            pptx="comparison_pptx:comparison_pptx",
        )
    ),
    "certkit-extraction/1": DocumentReport(
        _files(
            "extraction", html="extraction_report:extraction_page", pdf="extraction_report:extraction_pdf"
        ),
        _PAPER,
    ),
    "certkit-campaign/1": DocumentReport(
        {
            **_files("campaign", html="campaign_page:campaign_page", csv="campaign_csv:campaign_csv"),
            "junit": ("junit.xml", "certkit.reporting.campaign_junit:campaign_junit"),
            **_files("campaign", xlsx="campaign_xlsx:campaign_xlsx", pptx="campaign_pptx:campaign_pptx"),
        }
    ),
    "certkit-study/1": DocumentReport(_files("study", html="study_pages:study_page")),
    "certkit-optimum/1": DocumentReport(_files("optimum", html="study_pages:optimum_page")),
    "certkit-fit/1": DocumentReport(_files("fit", html="study_pages:calibration_page")),
    "certkit-certificate/1": DocumentReport(
        _files(
            "certificate",
            html="legform_certificate_report:certificate_page",
            pdf="legform_certificate_report:certificate_pdf",
        ),
        _PAPER,
        takes_paper=True,
    ),
    "certkit-logbook/1": DocumentReport(
        {"html": ("", "")}, writer="certkit.reporting.logbook_page:render_logbook"
    ),
    "certkit-uncertainty/1": DocumentReport(_files("uncertainty", html="uncertainty_page:uncertainty_page")),
    "certkit-twin/1": DocumentReport(_files("twin", html="twin_page:twin_page")),
    "certkit-round-robin/1": DocumentReport(_files("round-robin", html="round_robin_page:round_robin_page")),
}


def report_files(document: OutputDocument) -> set[str]:
    """Return the names of all files that a document's reports can be, as far as they are known here."""
    if document.schema_word() == "certkit-result/1":
        return {report_format(name).FILE for name in FORMATS}
    return {file for file, _ in REPORTS[document.schema_word()].formats.values() if file}


def render_document(
    document: OutputDocument,
    out: Path,
    formats: Sequence[str] | None = None,
    *,
    paper: Paper = "A4",
    spoken: str = ENGLISH,
    shown: dict[str, list[View]] | None = None,
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
    shown : dict, optional
        Gets the views of a result by their language, for a suite.

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
    wanted = report.usual if formats is None else formats
    options = {"paper": paper} if report.takes_paper else {}
    if report.writer:
        module, _, name = report.writer.partition(":")
        more = {} if shown is None else {"shown": shown}
        found: list[Path] = getattr(import_module(module), name)(
            document, out, wanted, spoken=spoken, **options, **more
        )
        return found
    from certkit.reporting.named_files import write_named  # noqa: PLC0415  # `--help` asks for formats alone

    return write_named(document, out, wanted, report.formats, spoken, options)


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
