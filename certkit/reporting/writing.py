"""From results to files: which format becomes which file, each written whole."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.errors import UsageError
from certkit.files import write_whole
from certkit.reporting.language import ENGLISH

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence
    from pathlib import Path

    from certkit.documents.result import Result
    from certkit.identification import ExtractionResult
    from certkit.reporting.pdf_certificate import Paper

FORMATS = ("html", "pdf", "junit", "csv", "md")
FILES = {
    "html": "report.html",
    "pdf": "report.pdf",
    "junit": "junit.xml",
    "csv": "channels.csv",
    "md": "summary.md",
}
SUITE_FILES = {"html": "index.html", "pdf": "suite.pdf", "junit": "junit.xml", "md": "summary.md"}


def checked(formats: Collection[str]) -> list[str]:
    """Return the formats in writing order, cheapest first, so that a missing Pango still leaves the others.

    Raises
    ------
    UsageError
        When one is not a format.
    """
    unknown = sorted(set(formats) - set(FORMATS) - {"json"})
    if unknown:
        raise UsageError(f"unknown format `{unknown[0]}`; use {', '.join(FORMATS)} (JSON is always written)")
    return [name for name in ("csv", "junit", "md", "html", "pdf") if name in formats]


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
    makers: dict[str, Callable[[], bytes | str | None]] = {
        "html": lambda: _page(result, spoken),
        "pdf": lambda: _pdf([result], paper, None, spoken),
        "junit": lambda: _junit([result]),
        "csv": lambda: _csv(result),
        "md": lambda: _summary([result]),
    }
    return _write(out, formats, makers, FILES)


def render_suite(
    results: Sequence[Result],
    out: Path,
    formats: Collection[str],
    *,
    title: str = "Certification suite",
    paper: Paper = "A4",
    spoken: str = ENGLISH,
) -> list[Path]:
    """Write what binds several results together: index page, one PDF with contents, JUnit, summary.

    The index page holds all reports, so it can be handed on as a single file.
    """
    results = [result.as_written() for result in results]
    makers: dict[str, Callable[[], bytes | str | None]] = {
        "html": lambda: _suite_page(results, title, spoken),
        "pdf": lambda: _pdf(results, paper, title, spoken),
        "junit": lambda: _junit(results),
        "md": lambda: _summary(results),
    }
    return _write(out, [name for name in formats if name != "csv"], makers, SUITE_FILES)


def _write(
    out: Path,
    formats: Collection[str],
    makers: dict[str, Callable[[], bytes | str | None]],
    files: dict[str, str],
) -> list[Path]:
    written = []
    for name in checked(formats):
        content = makers[name]()
        if content is not None:
            write_whole(out / files[name], content)
            written.append(out / files[name])
    return written


def render_extraction(result: ExtractionResult, out: Path, formats: Collection[str]) -> list[Path]:
    """Write the report of an extraction; see `certkit.reporting.extraction_report`."""
    from certkit.reporting.extraction_report import render_extraction as write  # noqa: PLC0415  # jinja2 waits

    return write(result, out, formats)


# Each format's modules are imported when it is asked for: a JUnit file must not wait for jinja2.


def _page(result: Result, spoken: str) -> str:
    from certkit.reporting.html_report import page  # noqa: PLC0415  # see above

    return page(result, spoken)


def _suite_page(results: Sequence[Result], title: str, spoken: str) -> str:
    from certkit.reporting.html_report import suite_page  # noqa: PLC0415  # see above

    return suite_page(results, title, spoken)


def _pdf(results: Sequence[Result], paper: Paper, title: str | None, spoken: str) -> bytes:
    from certkit.reporting.pdf_certificate import certificate  # noqa: PLC0415  # see above

    return certificate(results, paper=paper, title=title, contents=title is not None, spoken=spoken)


def _junit(results: Sequence[Result]) -> bytes:
    from certkit.reporting.junit import junit  # noqa: PLC0415  # see above

    return junit(results)


def _csv(result: Result) -> str | None:
    from certkit.exchange.channels_csv import channels_csv  # noqa: PLC0415  # see above

    return channels_csv(result)


def _summary(results: Sequence[Result]) -> str:
    from certkit.reporting.markdown import summary  # noqa: PLC0415  # see above

    return summary(results)
