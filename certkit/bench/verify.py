"""`verify`: check every hash of a certificate, then grade it again from what it carries."""

from __future__ import annotations

import hashlib
import math
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.bench.pdf_attachments import Attached, attachments_of
from certkit.bench.regrade import regrade
from certkit.documents.document_kinds import document_in, documents_from
from certkit.documents.result import Result
from certkit.errors import CertkitError, DataError
from certkit.exchange.channels_csv import channels_csv
from certkit.exchange.container import read_bounded
from certkit.reporting.language import worded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from certkit.documents.output_document import OutputDocument
    from certkit.documents.result import CriterionResult

SAME = 1e-5
"""Relative difference of values that count as the same: the document keeps seven digits of its channels."""


@dataclass(frozen=True)
class Check:
    """One thing that was checked: what it is called, whether it holds, and why not."""

    what: str
    holds: bool
    said: str = ""


@dataclass(frozen=True)
class Verification:
    """What came of all checks.

    Parameters
    ----------
    certificate : str
        The file or folder as the user named it.
    ids : tuple of str
        Certificate ids found in it.
    checks : tuple of Check
        In the order they were made.
    """

    certificate: str
    ids: tuple[str, ...]
    checks: tuple[Check, ...]

    @property
    def holds(self) -> bool:
        """Whether every check held."""
        return all(check.holds for check in self.checks)


def verify(path: str | Path) -> Verification:
    """Check a certificate.

    Parameters
    ----------
    path : str or Path
        A document that certkit wrote (`result.json`, `extraction.json`, …), `report.pdf` (by its
        attachments), or the folder of a run.

    Raises
    ------
    DataError
        When it is none of them, or so damaged that nothing can be checked.
    """
    path = Path(path)
    if path.is_dir():
        return _folder(path)
    if path.suffix.lower() == ".pdf":
        return _pdf(path)
    content = read_bounded(path)
    documents = documents_from(content, str(path))
    checks: list[Check] = []
    for document in documents:
        # In a list of several, the layout of each is not its own.
        checks += _document_checks(path.name, content, document, bytes_matter=len(documents) == 1)
        if isinstance(document, Result):
            checks += _grading_checks(document)
    return Verification(str(path), tuple(document.id for document in documents), tuple(checks))


def _folder(path: Path) -> Verification:
    document = document_in(path)
    if document is None:
        raise DataError(f"{path}: no result.json in it; name the folder of one run, a result.json or a PDF")
    if document.name != Result.file_name:
        return verify(document)
    content = read_bounded(document)
    result = _result(content, str(document))
    checks = _document_checks("result.json", content, result)
    table = path / "channels.csv"
    if table.is_file():
        checks.append(_table_check("channels.csv", read_bounded(table), result))
    checks += _report_checks(path, result)
    pdf = path / "report.pdf"
    if pdf.is_file():
        inside = _pdf(pdf, again=False)
        checks += [Check(f"report.pdf: {check.what}", check.holds, check.said) for check in inside.checks]
        same = result.id in inside.ids
        checks.append(
            Check("report.pdf: certificate", same, "" if same else f"certifies {', '.join(inside.ids)}")
        )
    checks += _grading_checks(result)
    return Verification(str(path), (result.id,), tuple(checks))


def _report_checks(path: Path, result: Result) -> Iterator[Check]:
    """Check that the reports beside a document are what it renders to; another certkit may draw otherwise."""
    if result.provenance.certkit != __version__:
        return
    from certkit.reporting.html_report import language_of, page  # noqa: PLC0415  # likewise
    from certkit.reporting.junit import junit  # noqa: PLC0415  # jinja2 only where there is a page to check
    from certkit.reporting.markdown import summary  # noqa: PLC0415  # likewise

    makers: dict[str, Callable[[], str | bytes]] = {
        "report.html": lambda: page(result, language_of(read_bounded(path / "report.html"))),
        "junit.xml": lambda: junit([result]),
        "summary.md": lambda: summary([result]),
    }
    for name, make in makers.items():
        if (path / name).is_file():
            made = make()
            same = read_bounded(path / name) == (made.encode() if isinstance(made, str) else made)
            yield Check(
                name, same, "" if same else "is not what result.json renders to; one of both was changed"
            )


def _pdf(path: Path, *, again: bool = True) -> Verification:
    attached = attachments_of(path)
    checks = list(_manifest_checks(attached))
    ids: list[str] = []
    shown: list[Result] = []
    for name, content in sorted(attached.files.items()):
        if name.rpartition("/")[2] != "result.json" and not name.endswith("-result.json"):
            continue
        result = _result(content, name, checks)
        ids.append(result.id)
        checks += _document_checks(name, content, result, bytes_matter=False)
        table = attached.files.get(name.removesuffix("result.json") + "channels.csv")
        if table is not None:
            checks.append(_table_check(name.removesuffix("result.json") + "channels.csv", table, result))
        shown.append(result)
        if again:
            checks += _grading_checks(result)
    if not ids:
        raise DataError(
            f"{path}: no result.json is attached; only certificates that certkit wrote can be verified"
        )
    checks += _pages_check(path, shown, attached)
    return Verification(str(path), tuple(ids), tuple(checks))


def _pages_check(path: Path, results: list[Result], attached: Attached) -> Iterator[Check]:
    """Check that the pages are what the attached document renders to; a signature only adds to them.

    Not for bound suites, whose title no document holds, nor for the pages of another certkit or WeasyPrint.
    """
    package = version("weasyprint")
    if len(results) != 1 or any(
        r.provenance.certkit != __version__ or r.provenance.packages.get("weasyprint") != package
        for r in results
    ):
        return
    from certkit.reporting.pdf_certificate import certificate  # noqa: PLC0415  # WeasyPrint takes a second

    content = read_bounded(path)
    same = content.startswith(
        certificate(results, paper=attached.paper, created=attached.created, spoken=attached.language)
    )
    yield Check(
        "pages", same, "" if same else "are not what the attached result.json renders to; one was changed"
    )


def _manifest_checks(attached: Attached) -> Iterator[Check]:
    for name in sorted(set(attached.listed) | set(attached.files)):
        if name not in attached.listed:
            yield Check(name, holds=False, said="is attached, but not in the manifest")
        elif name not in attached.files:
            yield Check(name, holds=False, said="is in the manifest, but not attached")
        else:
            same = hashlib.sha256(attached.files[name]).hexdigest() == attached.listed[name]
            yield Check(name, same, "" if same else "was changed since the certificate was made")


def _result(content: bytes, name: str, found: list[Check] | None = None) -> Result:
    """Read a document; when it is too damaged, say what the hashes have shown already."""
    try:
        return Result.from_json(content, name)
    except DataError as error:
        changed = [check.what for check in found or [] if not check.holds]
        if changed:
            raise DataError(
                f"{changed[0]} was changed since it was written, and cannot be read: {error}"
            ) from error
        raise


def _document_checks(
    name: str, content: bytes, document: OutputDocument, *, bytes_matter: bool = True
) -> list[Check]:
    """Check a document's own id, its bytes, and the hashes of the definitions that a result carries."""
    expected = document.content_id()
    same = expected == document.id
    said = "" if same else f"its content was changed: it says {document.id}, its content makes {expected}"
    checks = [Check(f"{name}: certificate id", same, said)]
    # Another certkit may know fewer or more fields, and writes those.
    if bytes_matter and same and not (isinstance(document, Result) and _of_another_certkit(document)):
        untouched = content == document.to_json().encode()
        checks.append(
            Check(f"{name}: bytes", untouched, "" if untouched else "are not as certkit writes them")
        )
    if not (isinstance(document, Result) and _of_another_certkit(document)):
        same = worded(document) == document
        checks.append(Check(f"{name}: words", same, "" if same else "are not those of its coded reasons"))
    if isinstance(document, Result):
        checks += _input_checks(name, document)
    return checks


def _of_another_certkit(result: Result) -> bool:
    return result.provenance.certkit != __version__


def _input_checks(name: str, result: Result) -> Iterator[Check]:
    for item in result.provenance.inputs:
        if item.text is None:
            continue
        digests = {hashlib.sha256(mark + item.text.encode()).hexdigest() for mark in (b"", b"\xef\xbb\xbf")}
        kept = item.sha256 in digests
        said = "" if kept else "was changed: its hash is another"
        yield Check(f"{name}: {item.role} {item.path}", kept, said)


def _table_check(name: str, content: bytes, result: Result) -> Check:
    table = (channels_csv(result) or "").encode()
    # Another certkit may say more or less of the test before the table.
    same = table == content or (_of_another_certkit(result) and _body(table) == _body(content))
    return Check(
        f"{name}: channels of the result", same, "" if same else "differ from the document's channels"
    )


def _body(table: bytes) -> list[bytes]:
    return [line for line in table.splitlines() if not line.startswith(b"#")]


def _grading_checks(result: Result) -> list[Check]:
    """Grade again, and compare the overall verdict and every criterion."""
    try:
        again = regrade(result)
    except CertkitError as error:
        return [Check("graded again", holds=False, said=" ".join(str(error).split()))]
    now = {criterion.id: criterion for criterion in again.criteria}
    checks = [
        Check(f"graded again: {before.id}", not (said := _difference(before, now.get(before.id))), said)
        for before in result.criteria
    ]
    same = again.verdict == result.verdict
    said = again.verdict if same else f"it said {result.verdict}; graded again it is {again.verdict}"
    return [*checks, Check("graded again: verdict", same, said)]


def _difference(before: CriterionResult, after: CriterionResult | None) -> str:
    """Say how a criterion differs; empty when it does not."""
    if after is None:
        return "is not among the procedure's criteria"
    if before.verdict != after.verdict:
        return f"it said {before.verdict}; graded again it is {after.verdict}"
    if (before.value is None) != (after.value is None):
        return "has a value in only one of both"
    if before.value is not None and after.value is not None:
        scale = max(abs(before.value), abs((before.upper or 0.0) - (before.lower or 0.0)))
        if not math.isclose(before.value, after.value, rel_tol=SAME, abs_tol=SAME * scale):
            return f"it said {before.value:.6g} {before.unit}; graded again it is {after.value:.6g}"
    limits = ((before.lower, after.lower), (before.upper, after.upper))
    return "" if all(_same_limit(*pair) for pair in limits) else "its corridor is another"


def _same_limit(before: float | None, after: float | None) -> bool:
    """Compare limits, of which the document keeps seven digits."""
    if before is None or after is None:
        return before is after
    return math.isclose(before, after, rel_tol=1e-6)
