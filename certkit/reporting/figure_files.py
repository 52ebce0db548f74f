"""From a document on disk to figures: of a result, or of an extraction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.document_kinds import document_at, read_documents
from certkit.documents.extraction import ExtractionResult
from certkit.documents.result import Result
from certkit.documents.unverified import trusted
from certkit.reporting.figures import figure

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path


def figure_files(
    document: Path,
    what: str,
    forms: Sequence[str],
    *,
    channels: Sequence[str] = (),
    beside: Path | None = None,
    unverified: bool = False,
) -> tuple[str, dict[str, bytes]]:
    """Draw a figure of the document in each format.

    Parameters
    ----------
    document : Path
        `result.json` or `extraction.json`.
    what, channels
        See `certkit.reporting.figures.figure`.
    forms : sequence of str
        `svg`, `png`.
    beside : Path, optional
        A second result.
    unverified : bool
        Draw documents that were changed since certkit wrote them as well, and say so in the figure.

    Returns
    -------
    str, dict of str to bytes
        The procedure's or case's name, and the content of each format's file.

    Raises
    ------
    UsageError
        When there is no such figure of that document.
    """
    found = read_documents(document_at(document), unverified=unverified)[0]
    other = trusted(Result.read(beside), str(beside), unverified=unverified) if beside else None
    name = found.case if isinstance(found, ExtractionResult) else getattr(found, "procedure", document.stem)
    return name, {form: figure(found, what, form, channels=channels, beside=other) for form in forms}
