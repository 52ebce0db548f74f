"""`render`: write a document and its reports into a folder, each file whole or not at all."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from certkit.files import write_whole

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from certkit.documents.output_document import OutputDocument
    from certkit.documents.result import Result
    from certkit.reporting.pdf_certificate import Paper


def render(
    document: OutputDocument,
    out: str | Path,
    formats: str | Collection[str] | None = None,
    *,
    paper: Paper = "A4",
    language: str = "en",
) -> list[Path]:
    """Write a document as JSON, and the wanted reports of it.

    Parameters
    ----------
    document : OutputDocument
        Any that certkit makes. An extraction is written with its vehicle file.
    out : str or Path
        Folder; made when missing.
    formats : str or collection of str, optional
        Of a result: `html`, `pdf`, `junit`, `csv`, `md`; others have `html`, an extraction `pdf` as well. In
        one string they are separated by commas; `none` writes the JSON alone. What people look at (`html`,
        and `pdf` where there is one) when not given.
    paper : {'A4', 'Letter'}
        Page size of the PDF, where there is a choice.
    language : str
        Of page and PDF: `en`, `de`, `ja`. The document's id is the same in each.

    Returns
    -------
    list of Path
        What was written, the JSON first.

    Raises
    ------
    UsageError
        When there is no such report of the document; nothing is written then.
    RunError
        When the PDF's libraries are missing; all other formats are written by then.
    """
    folder = Path(out)
    asked = reports_of(document, formats)
    file = folder / document.file_name
    text = document.to_json()
    write_whole(file, text)
    written = [file, *_vehicle(document, folder)]
    if not asked:
        return written
    from certkit.reporting.document_reports import render_document  # noqa: PLC0415  # likewise

    # From the text, whose numbers are rounded: reports are the ones that the document alone makes.
    return [*written, *render_document(document.from_json(text), folder, asked, paper=paper, spoken=language)]


def render_suite(
    results: Sequence[Result], out: str | Path, formats: str | Collection[str], *, language: str = "en"
) -> list[Path]:
    """Write the index page and the bound certificate of several results."""
    from certkit.reporting import render_suite as write  # noqa: PLC0415  # likewise

    return write(results, Path(out), split(formats), spoken=language)


def reports_of(
    document: OutputDocument | type[OutputDocument], formats: str | Collection[str] | None
) -> list[str]:
    """Return the wanted reports of a document, or of a kind of them before there is one; see `render`.

    Raises
    ------
    UsageError
        When this kind has no such report.
    """
    from certkit.reporting.document_reports import REPORTS, checked  # noqa: PLC0415  # waits until it is needed

    usual = REPORTS[document.schema_word()].usual
    return checked(document, usual if formats is None else split(formats))


def split(formats: str | Collection[str]) -> list[str]:
    """Return formats as a list; `none` and `json` ask for no report."""
    words = formats.split(",") if isinstance(formats, str) else formats
    return [word.strip() for word in words if word.strip() not in {"", "none", "json"}]


def _vehicle(document: OutputDocument, folder: Path) -> list[Path]:
    """Write the vehicle that an extraction found."""
    from certkit.documents.extraction import ExtractionResult  # noqa: PLC0415  # only where there is one

    if not isinstance(document, ExtractionResult) or not document.vehicle:
        return []
    from certkit.identification.vehicle_file import vehicle_text  # noqa: PLC0415  # likewise

    write_whole(folder / "vehicle.yaml", vehicle_text(document))
    return [folder / "vehicle.yaml"]
