"""From a document on disk to figures: of a result, or of an extraction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.document_kinds import read_documents
from certkit.documents.extraction import ExtractionResult
from certkit.documents.result import Result
from certkit.documents.unverified import is_marked, trusted
from certkit.errors import UsageError
from certkit.reporting.figures import figure, painted, stamped

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
        See `certkit.reporting.figure`; of an extraction `momentum`, `impulse`, `force`, `stiffness` or
        `material`, with load paths for channels.
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
    found = read_documents(document, unverified=unverified)[0]
    if isinstance(found, ExtractionResult):
        return _of_extraction(found, document, what, forms, channels)
    if not isinstance(found, Result):
        raise UsageError(f"{document}: there are figures of results and extractions, not of a {found.noun}")
    other = trusted(Result.read(beside), str(beside), unverified=unverified) if beside else None
    return found.procedure, {
        form: figure(found, what, form, channels=channels, beside=other) for form in forms
    }


def _of_extraction(
    result: ExtractionResult, document: Path, what: str, forms: Sequence[str], paths: Sequence[str]
) -> tuple[str, dict[str, bytes]]:
    from certkit.reporting.extraction_report import EXTRACTION_FIGURES, extraction_drawing  # noqa: PLC0415  # likewise

    if what not in EXTRACTION_FIGURES:
        raise UsageError(f"an extraction has no figure `{what}`; use {', '.join(EXTRACTION_FIGURES)}")
    drawing = extraction_drawing(result, what, paths)
    if drawing is None:
        raise UsageError(f"{document}: the extraction holds nothing to draw `{what}` from")
    if is_marked(result):
        drawing = stamped(drawing)
    return result.case, {form: painted(drawing, form) for form in forms}
