"""From a document on disk to figures: of a result, or of an extraction."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.result_json import read_result
from certkit.errors import UsageError
from certkit.reporting.figures import figure, painted

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

_HEAD = 4096
"""Characters at either end of a document in which its schema is looked for; keys may be sorted or not."""


def figure_files(
    document: Path,
    what: str,
    forms: Sequence[str],
    *,
    channels: Sequence[str] = (),
    beside: Path | None = None,
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

    Returns
    -------
    str, dict of str to bytes
        The procedure's or case's name, and the content of each format's file.

    Raises
    ------
    UsageError
        When there is no such figure of that document.
    """
    if _is_extraction(document):
        return _of_extraction(document, what, forms, channels)
    result = read_result(document)
    other = read_result(beside) if beside else None
    return result.procedure, {
        form: figure(result, what, form, channels=channels, beside=other) for form in forms
    }


def _is_extraction(document: Path) -> bool:
    try:
        text = document.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False  # `read_result` says what is wrong
    return '"certkit-extraction/' in text[:_HEAD] + text[-_HEAD:]


def _of_extraction(
    document: Path, what: str, forms: Sequence[str], paths: Sequence[str]
) -> tuple[str, dict[str, bytes]]:
    from certkit.identification import ExtractionResult  # noqa: PLC0415  # numpy waits
    from certkit.reporting.extraction_report import EXTRACTION_FIGURES, extraction_drawing  # noqa: PLC0415  # likewise

    if what not in EXTRACTION_FIGURES:
        raise UsageError(f"an extraction has no figure `{what}`; use {', '.join(EXTRACTION_FIGURES)}")
    result = ExtractionResult.from_json(document.read_text(encoding="utf-8"))
    drawing = extraction_drawing(result, what, paths)
    if drawing is None:
        raise UsageError(f"{document}: the extraction holds nothing to draw `{what}` from")
    return result.case, {form: painted(drawing, form) for form in forms}
