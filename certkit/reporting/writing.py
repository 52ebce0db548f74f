"""From results to files: which format becomes which file, each written whole."""

from __future__ import annotations

from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING

from certkit.errors import UsageError
from certkit.files import write_whole
from certkit.reporting.language import ENGLISH

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence
    from pathlib import Path

    from certkit.documents.result import Result
    from certkit.identification import ExtractionResult
    from certkit.reporting.pdf_certificate import Paper

FORMATS = MappingProxyType(
    {
        "csv": "certkit.reporting.csv_report",
        "junit": "certkit.reporting.junit",
        "md": "certkit.reporting.markdown",
        "html": "certkit.reporting.html_report",
        "pdf": "certkit.reporting.pdf_certificate",
    }
)
"""The module of each format, cheapest first, so that a missing Pango still leaves the others.

A format is one file and one line here. It has `FILE` and `SUITE_FILE`, its files for one result and for
several (None: there is none), and `write(results, *, title, paper, spoken)`, which returns the content, or
None where there is nothing to write. It is imported when it is asked for: JUnit must not wait for jinja2.
"""


SUITE_TITLE = "Certification suite"


def checked(formats: Collection[str]) -> list[str]:
    """Return the formats in writing order.

    Raises
    ------
    UsageError
        When one is not a format.
    """
    unknown = sorted(set(formats) - set(FORMATS) - {"json"})
    if unknown:
        raise UsageError(f"unknown format `{unknown[0]}`; use {', '.join(FORMATS)} (JSON is always written)")
    return [name for name in FORMATS if name in formats]


def render(
    result: Result, out: Path, formats: Collection[str], *, paper: Paper = "A4", spoken: str = ENGLISH
) -> list[Path]:
    """Write the reports of one result into a folder.

    Parameters
    ----------
    result : Result
        The document; nothing else is read.
    out : Path
        Folder; made when missing.
    formats : collection of str
        Of `html`, `pdf`, `junit`, `csv`, `md`; `json` is ignored here, since grading writes it.
    paper : {'A4', 'Letter'}
        Page size of the PDF.
    spoken : str
        Language of page and PDF; files for machines, and the summary, are English.

    Returns
    -------
    list of Path
        The files written. `channels.csv` is left out when the result holds no raw channels.

    Raises
    ------
    UsageError
        When a format is unknown.
    RunError
        When the PDF's libraries are missing; all other formats are written by then.
    """
    return render_written(result.as_written(), out, formats, paper=paper, spoken=spoken)


def render_written(
    result: Result, out: Path, formats: Collection[str], *, paper: Paper = "A4", spoken: str = ENGLISH
) -> list[Path]:
    """Do as `render` does, with a result that was read from its own JSON and so has its digits already."""
    return _write([result], out, formats, title=None, paper=paper, spoken=spoken)


def render_suite(
    results: Sequence[Result],
    out: Path,
    formats: Collection[str],
    *,
    title: str = SUITE_TITLE,
    paper: Paper = "A4",
    spoken: str = ENGLISH,
) -> list[Path]:
    """Write what binds several results together: index page, one PDF with contents, JUnit, summary.

    The index page holds all reports, so it can be handed on as a single file.
    """
    results = [result.as_written() for result in results]
    return _write(results, out, formats, title=title, paper=paper, spoken=spoken)


def _write(  # what a format takes
    results: Sequence[Result],
    out: Path,
    formats: Collection[str],
    *,
    title: str | None,
    paper: Paper,
    spoken: str,
) -> list[Path]:
    written = []
    for name in checked(formats):
        module = import_module(FORMATS[name])
        file = module.FILE if title is None else module.SUITE_FILE
        content = None
        if file is not None:
            content = module.write(results, title=title, paper=paper, spoken=spoken)
        if content is not None:
            write_whole(out / file, content)
            written.append(out / file)
    return written


def render_extraction(result: ExtractionResult, out: Path, formats: Collection[str]) -> list[Path]:
    """Write the report of an extraction; see `certkit.reporting.extraction_report`."""
    from certkit.reporting.extraction_report import render_extraction as write  # noqa: PLC0415  # jinja2 waits

    return write(result, out, formats)
