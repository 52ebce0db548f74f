"""Write what a run or grading yields, whole or not at all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.files import write_whole

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from pathlib import Path

    from certkit.documents.result import Result


def save(result: Result, out: Path, formats: Collection[str]) -> list[Path]:
    """Write `result.json` and the wanted reports into a folder.

    Parameters
    ----------
    result : Result
    out : Path
        Made when missing.
    formats : collection of str
        Of `html`, `pdf`, `junit`, `csv`, `md`.

    Returns
    -------
    list of Path
        What was written, the JSON first.
    """
    document = out / result.file_name
    text = result.to_json()
    write_whole(document, text)
    if not formats:
        return [document]
    from certkit.reporting.writing import render_written  # noqa: PLC0415  # only where a report is wanted

    # From the text, whose numbers are rounded, so that reports are the ones that the document alone makes.
    return [document, *render_written(result.from_json(text), out, formats)]


def save_suite(results: Sequence[Result], out: Path, formats: Collection[str]) -> list[Path]:
    """Write the index page and the bound certificate of several results."""
    from certkit.reporting import render_suite  # noqa: PLC0415  # likewise

    return render_suite(results, out, formats)
