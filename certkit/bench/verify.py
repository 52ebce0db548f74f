"""`verify`: say whether a certificate holds, what was checked for it, and what was not.

Each kind of check is a file of its own: integrity (`verify_document`, `verify_attachments`,
`verify_reports`), the PDF as a file and its pages (`verify_pdf_file`, `verify_pages`), grading again
(`verify_grading`), simulating again (`verify_reproduction`), sources (`verify_sources`), the signature
(`verify_signature`), and whether a later report took its place (`verify_replacement`). A legform's
certificate and a campaign have further ones (`verify_legform_certificate`, `verify_campaign`).
"""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from certkit.bench.pdf_attachments import attachments_of
from certkit.bench.verification import Check, Verification, fails, holds, judged, unchecked
from certkit.bench.verify_attachments import attachment_checks, manifest_checks
from certkit.bench.verify_beside import beside_checks, others_beside
from certkit.bench.verify_campaign import campaign_checks
from certkit.bench.verify_document import document_checks, table_check
from certkit.bench.verify_grading import grading_checks
from certkit.bench.verify_legform_certificate import legform_checks, logbook_check
from certkit.bench.verify_replacement import replacement_checks, results_in
from certkit.bench.verify_reports import report_checks
from certkit.bench.verify_reproduction import reproduction_checks
from certkit.bench.verify_sources import definition_checks, source_checks
from certkit.bench.verify_suite import in_one, suite_runs, suite_verification
from certkit.documents.campaign_report import CampaignReport
from certkit.documents.document_kinds import document_in, documents_from
from certkit.documents.legform_certificate import LOGBOOK, LegformCertificate
from certkit.documents.result import Result
from certkit.errors import DataError, OldFormWarning, UsageError
from certkit.files.bounded import read_bounded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from certkit.bench.pdf_attachments import Attached
    from certkit.bench.verify_pages import Printed


class Wanted(Struct, frozen=True):
    """What is checked beside the certificate itself, and what is left out."""

    data: tuple[Path, ...] = ()
    trust: Path | None = None
    quick: bool = False
    others: tuple[Result, ...] = ()


def verify(
    path: str | Path,
    data: Sequence[str | Path] = (),
    *,
    trust: str | Path | None = None,
    quick: bool = False,
    others: Sequence[str | Path] = (),
) -> Verification:
    """Check a certificate.

    Parameters
    ----------
    path : str or Path
        A document that certkit wrote (`result.json`, `extraction.json`, …), `report.pdf` (by its
        attachments), or the folder of a run or of a suite, whose checks each name their run.
    data : sequence of str or Path
        Recordings behind it, to compare with their hashes and channels.
    trust : str or Path, optional
        Certificates (PEM or DER) of the roots that the signer of a PDF has to be vouched for by.
    quick : bool
        Do not simulate a simulated certificate again.
    others : sequence of str or Path
        Other certificates: a report that one of them replaced does not hold any more.

    Raises
    ------
    DataError
        When it is none of them, or so damaged that nothing can be checked.
    UsageError
        When a file of `trust` or `data` is missing.
    """
    found = verify_each(path, data, trust=trust, quick=quick, others=others)
    return in_one(str(Path(path)), found)


def verify_each(
    path: str | Path,
    data: Sequence[str | Path] = (),
    *,
    trust: str | Path | None = None,
    quick: bool = False,
    others: Sequence[str | Path] = (),
) -> list[Verification]:
    """Do as `verify`; of a suite's folder, each run by itself, then what binds them."""
    path = Path(path)
    runs = suite_runs(path)
    beside = tuple(
        result for other in (*others, *runs) if Path(other) != path for result in results_in(Path(other))
    )
    wanted = Wanted(tuple(map(Path, data)), None if trust is None else Path(trust), quick, beside)
    for given in (*wanted.data, *((wanted.trust,) if wanted.trust else ())):
        if not given.exists():
            raise UsageError(f"{given}: there is no such file or folder; check the name")
    if runs:
        bound = suite_verification(path, runs, lambda pdf: _pdf(pdf, wanted, content_too=False))
        return [*(_folder(run, wanted) for run in runs), *bound]
    return [_folder(path, wanted) if path.is_dir() else _file(path, wanted)]


def _file(path: Path, wanted: Wanted) -> Verification:
    if path.suffix.lower() == ".pdf":
        return _pdf(path, wanted)
    content = read_bounded(path)
    documents = documents_from(content, str(path))
    checks: list[Check] = []
    for document in documents:
        # In a list of several, the layout of each is not its own.
        checks += document_checks(path.name, content, document, bytes_matter=len(documents) == 1)
        if isinstance(document, Result):
            checks += _content_checks(document, wanted)
        if isinstance(document, LegformCertificate):
            checks += legform_checks(document, lambda result: _content_checks(result, wanted))
        if isinstance(document, CampaignReport):
            checks += campaign_checks(path.parent, document, lambda result: _content_checks(result, wanted))
        elif not isinstance(document, Result | LegformCertificate):
            checks.append(unchecked("content", "content-not-derived"))
    graded = (document for document in documents if isinstance(document, Result | LegformCertificate))
    verdicts = tuple(document.verdict for document in graded)
    return Verification(str(path), tuple(document.id for document in documents), tuple(checks), verdicts)


def is_certificate(path: Path) -> bool:
    """Tell whether a path is something to verify, rather than a recording to verify it with."""
    return path.suffix.lower() in {".json", ".pdf"} or bool(
        path.is_dir() and (document_in(path) or suite_runs(path))
    )


def _content_checks(result: Result, wanted: Wanted) -> list[Check]:
    """Check what a result says, whatever file it stands in."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", OldFormWarning)  # whoever verifies did not write the definitions
        return [
            *grading_checks(result),
            *reproduction_checks(result, quick=wanted.quick),
            *definition_checks(result),
            *source_checks(result, wanted.data),
            *replacement_checks(result, wanted.others),
        ]


def _folder(path: Path, wanted: Wanted) -> Verification:
    document = document_in(path)
    if document is None:
        raise DataError(
            f"{path}: no result.json in it or its folders; name the folder of a run, a result.json or a PDF"
        )
    if document.name != Result.file_name:
        found = _file(document, wanted)
        beside = beside_checks(path, document, lambda pdf: _pdf(pdf, wanted))
        return replace(found, checks=(*found.checks, *beside))
    content = read_bounded(document)
    result = Result.from_json(content, str(document))
    checks = [*document_checks("result.json", content, result), *report_checks(path, result)]
    pdf = path / "report.pdf"
    if pdf.is_file():
        inside = _pdf(pdf, wanted, content_too=False)
        checks += [
            Check(f"report.pdf: {each.what}", each.outcome, each.code, each.parameters, each.asked)
            for each in inside.checks
        ]
        same = result.id in inside.ids
        checks.append(judged("report.pdf: certificate", same, "other-certificate", ids=", ".join(inside.ids)))
    checks += [*_content_checks(result, wanted), *others_beside(path, [result])]
    return Verification(str(path), (result.id,), tuple(checks), (result.verdict,))


def _pdf(path: Path, wanted: Wanted, *, content_too: bool = True) -> Verification:
    content = read_bounded(path)
    attached = attachments_of(path, content)
    checks = list(manifest_checks(attached))
    results: list[Result] = []
    if LegformCertificate.file_name in attached.files:
        return _legform_pdf(path, content, attached, checks, wanted)
    for name, held in attached.results.items():
        prefix = name.removesuffix(Result.file_name)
        result = _result(held, name, checks)
        results.append(result)
        checks += document_checks(name, held, result, bytes_matter=False)
        checks += attachment_checks(attached, result, prefix)
        table = attached.files.get(f"{prefix}channels.csv")
        if table is not None:
            checks.append(table_check(f"{prefix}channels.csv", table, result))
        if content_too:
            checks += _content_checks(result, wanted)
    if not results:
        raise DataError(
            f"{path}: no result.json is attached; only certificates that certkit wrote can be verified"
        )
    results, listed = _ordered(results, attached)
    checks.append(listed)
    checks += _paper_checks(path, content, lambda: _printed(results, attached), wanted)
    verdicts = tuple(result.verdict for result in results)
    return Verification(str(path), tuple(result.id for result in results), tuple(checks), verdicts)


def _legform_pdf(
    path: Path, content: bytes, attached: Attached, checks: list[Check], wanted: Wanted
) -> Verification:
    name = LegformCertificate.file_name
    document = LegformCertificate.from_json(attached.files[name], name)
    checks += document_checks(name, attached.files[name], document)
    checks += legform_checks(document, lambda result: _content_checks(result, wanted))
    checks.append(logbook_check(document, attached.files.get(LOGBOOK, b""), attached.language))
    checks += _paper_checks(path, content, lambda: _printed_certificate(document, attached), wanted)
    return Verification(str(path), (document.id,), tuple(checks), (document.verdict,))


def _ordered(results: list[Result], attached: Attached) -> tuple[list[Result], Check]:
    """Bring the documents into the order of the manifest, and check that it names just these."""
    order = {each: number for number, each in enumerate(attached.certificates)}
    told = {"said": ", ".join(attached.certificates), "made": ", ".join(result.id for result in results)}
    same = sorted(attached.certificates) == sorted(result.id for result in results)
    check = holds("manifest: certificates") if same else fails("manifest: certificates", "ids-differ", **told)
    return sorted(results, key=lambda result: order.get(result.id, len(order))), check


def _printed(results: list[Result], attached: Attached) -> Printed:
    """Return what the PDF of results should be."""
    from certkit.bench.verify_pages import Printed, rendered_again  # noqa: PLC0415  # only for a PDF

    return Printed.of(results, rendered_again(results, attached))


def _printed_certificate(document: LegformCertificate, attached: Attached) -> Printed:
    """Return what the PDF of a legform's certificate should be."""
    from certkit.bench.verify_pages import Printed, certificate_again  # noqa: PLC0415  # only for a PDF

    return Printed.of(document.results, certificate_again(document, attached), [document.id])


def _paper_checks(
    path: Path, content: bytes, rendered: Callable[[], Printed], wanted: Wanted
) -> Iterator[Check]:
    """Check the PDF as a file, its signatures, and its pages."""
    from certkit.bench.pdf_pages import pdf_pages  # noqa: PLC0415  # PDFium and WeasyPrint: only for a PDF
    from certkit.bench.verify_pages import page_checks  # noqa: PLC0415  # likewise
    from certkit.bench.verify_pdf_file import file_checks, first_revision, update_checks, word_checks  # noqa: PLC0415  # likewise
    from certkit.bench.verify_signature import signature_checks, signature_count  # noqa: PLC0415  # likewise

    signatures = signature_count(content)
    pages = pdf_pages(content, str(path))
    yield from signature_checks(content, wanted.trust)
    printed = rendered()
    made = printed.made
    before = first_revision(content)
    if isinstance(made, bytes) and content.rstrip(b"\r\n") == made.rstrip(b"\r\n"):
        yield holds("file", "file-structure-holds")
    else:
        yield from file_checks(content, pages, signatures=signatures)
        if before is not content:
            yield from update_checks(pdf_pages(before, str(path)), pages)
    unsigned = before if signatures else content
    if isinstance(made, bytes):
        yield from word_checks(unsigned, made, same_engine=printed.same_engine)
    yield from page_checks(
        unsigned, pages if unsigned is content else pdf_pages(unsigned, str(path)), printed
    )


def _result(content: bytes, name: str, found: list[Check]) -> Result:
    """Read a document; when it is too damaged, say what the hashes have shown already."""
    try:
        return Result.from_json(content, name)
    except DataError as error:
        changed = [check.what for check in found if not check.holds]
        if changed:
            raise DataError(
                f"{changed[0]} was changed since it was written, and cannot be read: {error}"
                "; ask its maker for the original"
            ) from error
        raise
