"""Check whether a report was replaced by others that are handed beside it; the results that these hold."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.bench.pdf_attachments import attachments_of
from certkit.bench.verification import Check, fails
from certkit.bench.verify_suite import suite_runs
from certkit.documents.document_kinds import document_in, documents_from
from certkit.documents.legform_certificate import LegformCertificate
from certkit.documents.result import Result
from certkit.errors import DataError
from certkit.files.bounded import read_bounded
from certkit.logbooks.logbook_entry import entry_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path


def replacement_checks(result: Result, others: Iterable[Result]) -> Iterator[Check]:
    """Say which of the others replaces a report, when, and why.

    A report that none of them replaces says nothing: it cannot be known that there is no other.
    """
    try:
        old = entry_of(result, result.id)
    except DataError:
        return
    for other in others:
        try:
            new = entry_of(other, other.id)
        except DataError:
            continue
        if new.takes_the_place_of(old):
            test = (other.laboratory or {}).get("test") or {}
            yield fails(
                f"in force: {old.number or old.id}",
                "replaced-by",
                number=new.number or new.id,
                revision=new.revision,
                id=new.id,
                issued=test.get("issued", "an unknown day"),
                reason=test.get("reason", "not stated"),
                changes=test.get("changes", "not stated"),
            )


def results_in(path: Path) -> list[Result]:
    """Return the results of a document, of a PDF, or of the folder of a run or a suite.

    Raises
    ------
    DataError
        When it is none of them.
    """
    runs = suite_runs(path)
    if runs:
        return [result for run in runs for result in results_in(run)]
    if path.is_dir():
        path = document_in(path) or path
    if path.suffix.lower() == ".pdf":
        attached, whole = attachments_of(path), LegformCertificate.file_name
        texts = {whole: attached.files[whole]} if whole in attached.files else attached.results
    else:
        texts = {str(path): read_bounded(path)}
    found = [document for name, text in texts.items() for document in documents_from(text, name)]
    return [
        result
        for document in found
        for result in (document.results if isinstance(document, LegformCertificate) else [document])
        if isinstance(result, Result)
    ]
