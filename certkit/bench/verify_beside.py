"""Checks of what lies beside a document: its pages, rendered again, and files that were not looked at."""

from __future__ import annotations

import re
from importlib import import_module
from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit._version import __version__
from certkit.bench.verification import Check, Verification, judged, left_out, unchecked
from certkit.bench.verify_legform_certificate import page_check
from certkit.documents.campaign_report import CampaignReport
from certkit.documents.document_kinds import documents_from
from certkit.documents.legform_certificate import LegformCertificate
from certkit.files.bounded import read_bounded
from certkit.reporting.document_reports import REPORTS, report_files
from certkit.reporting.named_files import TRANSLATED

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator
    from pathlib import Path

    from certkit.documents.output_document import OutputDocument

AGAIN = ("html", "csv", "junit")
"""Formats whose bytes follow from the document alone."""
VEHICLE = "vehicle.yaml"
NAMED = 5
"""Files that are named at most; the others are counted."""

_GENERATOR = re.compile(rb'<meta name="generator" content="certkit ([^"]{1,40})"')


def beside_checks(folder: Path, path: Path, check_pdf: Callable[[Path], Verification]) -> Iterator[Check]:
    """Check what lies in a folder beside a document that is no result.

    Parameters
    ----------
    folder, path : Path
        The document's folder, and its file.
    check_pdf : callable
        Checks the PDF of a legform's certificate.
    """
    documents = documents_from(read_bounded(path), str(path))
    for document in documents if len(documents) == 1 else ():
        yield from vehicle_check(folder, document)
        if not isinstance(document, LegformCertificate):
            yield from page_checks(folder, document)
            continue
        yield from page_check(folder, path)
        pdf = folder / "certificate.pdf"
        if pdf.is_file():
            inside = check_pdf(pdf)
            yield from (replace(each, what=f"{pdf.name}: {each.what}") for each in inside.checks)
            same, ids = document.id in inside.ids, ", ".join(inside.ids)
            yield judged(f"{pdf.name}: certificate", same, "other-certificate", ids=ids)
    yield from others_beside(folder, documents)


def page_checks(folder: Path, document: OutputDocument) -> Iterator[Check]:
    """Check the reports of a document that is no result, as far as they can be rendered again.

    Parameters
    ----------
    folder : Path
        That document and reports lie in.
    document : OutputDocument
        As it was read.
    """
    for form, (file, home) in REPORTS[document.schema_word()].formats.items():
        if not file or not (folder / file).is_file():
            continue
        if form not in AGAIN:
            yield left_out(file, "pdf-not-compared" if form == "pdf" else "not-compared")
            continue
        content = read_bounded(folder / file)
        said = _GENERATOR.search(content[:5000])
        version = __version__ if said is None else said[1].decode("utf-8", "replace")
        if version != __version__:
            yield unchecked(file, "made-by-another-version", version=version, now=__version__)
        else:
            yield judged(file, _again(document, form, home, content) == content, "page-differs")


def vehicle_check(folder: Path, document: OutputDocument) -> Iterator[Check]:
    """Check that the vehicle beside an extraction is the one that it found."""
    from certkit.documents.extraction import ExtractionResult  # noqa: PLC0415  # only where there is one

    path = folder / VEHICLE
    if isinstance(document, ExtractionResult) and document.vehicle and path.is_file():
        from certkit.identification.vehicle_file import vehicle_text  # noqa: PLC0415  # likewise

        made = vehicle_text(document)
        yield judged(VEHICLE, read_bounded(path) == made.encode(), "page-differs")


def _again(document: OutputDocument, form: str, home: str, content: bytes) -> bytes:
    """Render a report again, in the language of what is there."""
    from certkit.reporting.html_report import language_of  # noqa: PLC0415  # jinja2 waits

    module, _, function = home.partition(":")
    options = {"spoken": language_of(content)} if form in TRANSLATED else {}
    made = getattr(import_module(module), function)(document, **options)
    return made.encode() if isinstance(made, str) else bytes(made)


def others_beside(folder: Path, documents: Collection[OutputDocument]) -> Iterator[Check]:
    """Say which files in a folder nothing was held against, whatever they call themselves."""
    known = {name for each in documents for name in (*report_files(each), each.file_name)}
    if any(each.noun == "extraction" for each in documents):
        known.add(VEHICLE)
    for each in documents:
        if isinstance(each, CampaignReport):
            sources = (source for point in each.points for source in point.sources)
            known |= {source.folder.partition("/")[0] for source in sources if source.folder}
    yield from unknown_files(folder, known)


def unknown_files(folder: Path, known: Collection[str | None]) -> Iterator[Check]:
    """Name what lies in a folder beside what is known there; hidden files are nobody's report."""
    found = sorted(each.name for each in folder.iterdir() if each.name not in known)
    shown = [name for name in found if not name.startswith(".")]
    if shown:
        more = f" (+{len(shown) - NAMED})" if len(shown) > NAMED else ""
        yield left_out("other files", "files-not-looked-at", names=", ".join(shown[:NAMED]) + more)
