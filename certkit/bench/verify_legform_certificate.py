"""Checks of a legform's certificate: that it follows from the results and the logbook that it holds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit._version import __version__
from certkit.bench.compare_documents import differences
from certkit.bench.verification import Check, fails, holds, judged, unchecked
from certkit.bench.verify_document import document_checks, of_another_certkit
from certkit.documents.legform_certificate import LOGBOOK, LegformCertificate
from certkit.errors import CertkitError
from certkit.files.bounded import read_bounded
from certkit.logbooks import Issue, certificate_of
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from certkit.documents.result import Result

FIELDS = ("serial", "legform", "day", "verdict", "coded_remarks", "rules", "next_due", "tests")
"""What follows from the results and the logbook, each told by itself."""


def legform_checks(
    document: LegformCertificate, content_checks: Callable[[Result], list[Check]]
) -> Iterator[Check]:
    """Check a certificate.

    Parameters
    ----------
    document : LegformCertificate
        Whose own id and bytes have been checked.
    content_checks : callable
        Checks of what a result says: grades it again and so on.
    """
    yield from document_checks("logbook", b"", document.logbook, bytes_matter=False)
    for result in document.results:
        for each in (
            *document_checks("result", b"", result, bytes_matter=False),
            *content_checks(result),
        ):
            yield replace(each, what=f"{result.procedure}: {each.what}")
    issue = Issue(document.laboratory, document.number)
    try:
        made = worded(certificate_of(document.logbook, document.results, issue))
    except CertkitError as error:
        for fault in str(error).splitlines():
            yield fails("tests of the certificate", "certificate-refused", error=fault)
        return
    for name in FIELDS:
        what = f"put together again: {name.removeprefix('coded_')}"
        found = next(differences(getattr(document, name), getattr(made, name), name), None)
        if found is None:
            yield holds(what)
        elif any(of_another_certkit(result) for result in document.results):
            yield unchecked(what, "words-of-another-version", place=found.place, version=document.certkit)
        else:
            yield fails(what, "field-differs", place=found.place, said=found.said, made=found.made)


def logbook_check(document: LegformCertificate, content: bytes, spoken: str) -> Check:
    """Check that the attached page of the logbook is the one that the certificate's logbook renders to."""
    from certkit.reporting.logbook_page import logbook_page  # noqa: PLC0415  # jinja2 waits

    if any(of_another_certkit(result) for result in document.results):
        return unchecked(LOGBOOK, "made-by-another-version", version=document.certkit, now=__version__)
    return judged(LOGBOOK, content == logbook_page([document.logbook], spoken).encode(), "rendering-differs")


def page_check(folder: Path, path: Path) -> Iterator[Check]:
    """Check the page that lies beside a certificate, if `path` is one."""
    from certkit.reporting.html_report import language_of  # noqa: PLC0415  # jinja2 waits
    from certkit.reporting.legform_certificate_report import PAGE, certificate_page  # noqa: PLC0415  # likewise

    page = folder / PAGE
    if path.name != LegformCertificate.file_name or not page.is_file():
        return
    document, content = LegformCertificate.read(path), read_bounded(page)
    if any(of_another_certkit(result) for result in document.results):
        yield unchecked(PAGE, "made-by-another-version", version=document.certkit, now=__version__)
        return
    made = certificate_page(document, language_of(content)).encode()
    yield judged(PAGE, content == made, "rendering-differs")
