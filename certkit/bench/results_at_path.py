"""The results that a path carries: a `result.json`, a list of them, a run's folder, a certificate's PDF."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from certkit.bench.pdf_attachments import attachments_of
from certkit.documents.document_kinds import read_documents
from certkit.documents.result import Result
from certkit.documents.unverified import trusted
from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Iterator


def results_at(path: str | Path, *, unverified: bool = False) -> Iterator[tuple[str, Result]]:
    """Yield each result that a path carries, with its place for messages.

    Parameters
    ----------
    path : str or Path
    unverified : bool
        Take one that was changed since certkit wrote it as well, marked as such.

    Raises
    ------
    DataError
        When it carries none, is damaged, or was changed.
    """
    given = Path(path)
    file = Result.file_at(given)
    if file.suffix.lower() == ".pdf":
        yield from _attached(file, unverified=unverified)
        return
    for number, document in enumerate(read_documents(file, unverified=unverified), 1):
        if not isinstance(document, Result):
            raise DataError(f"{file}: item {number} is a {document.noun}; name results of tests")
        yield str(given), document


def _attached(file: Path, *, unverified: bool) -> Iterator[tuple[str, Result]]:
    attached = attachments_of(file).results
    if not attached:
        raise DataError(f"{file}: no result.json is attached; name a certificate that certkit wrote")
    for name, content in attached.items():
        place = f"{file}:{name}"
        yield place, trusted(Result.from_json(content, place), place, unverified=unverified)


def result_at(path: Path, *, unverified: bool = False) -> Result | None:
    """Return the result that a path names by its file or its folder; None where it names measured data.

    Raises
    ------
    DataError
        When it is damaged, or was changed.
    """
    file = Result.file_at(path)
    if file.suffix.lower() != ".json" or not file.is_file():
        return None
    return trusted(Result.read(file), str(file), unverified=unverified)
