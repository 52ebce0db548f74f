"""From results to files: which format becomes which file, each written whole."""

from __future__ import annotations

import html
import re
from importlib import import_module
from typing import TYPE_CHECKING

from msgspec.structs import replace

from certkit.errors import MissingPartError, UsageError
from certkit.files import write_whole
from certkit.reporting.language import ENGLISH
from certkit.reporting.left_out import leave_out
from certkit.reporting.report_formats import FORMATS, report_format
from certkit.reporting.result_view import unique_views

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence
    from pathlib import Path

    from certkit.documents.result import Result
    from certkit.reporting.report_formats import Paper
    from certkit.reporting.result_view import View

SUITE_TITLE = "Certification suite"
TITLE_BYTES = 5000
"""Of a page, within which its title stands."""

_TITLE = re.compile(rb"<title>([^<]*)</title>")


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
    result: Result,
    out: Path,
    formats: Collection[str],
    *,
    paper: Paper = "A4",
    spoken: str = ENGLISH,
    shown: dict[str, list[View]] | None = None,
) -> list[Path]:
    """Write the reports of one result into a folder.

    Parameters
    ----------
    result : Result
        The document, with the digits of its file (`as_written`); nothing else is read.
    out : Path
        Folder; made when missing.
    formats : collection of str
        Of `FORMATS`; `json` is ignored here, since grading writes it.
    paper : {'A4', 'Letter'}
        Page size of the PDF.
    spoken : str
        Language of page and PDF; files for machines, and the summary, are English.
    shown : dict, optional
        Gets the result's views by their language, for a suite of it.

    Returns
    -------
    list of Path
        The files written. `channels.csv` is left out when the result holds no raw channels, and the PDF, with
        a `LeftOutWarning`, where a library or a font that it needs is missing.

    Raises
    ------
    UsageError
        When a format is unknown.
    """
    views: dict[str, list[View]] = {}
    written = _write([result], views, out, formats, title=None, paper=paper, spoken=spoken)
    if shown is not None:
        for code, made in views.items():
            shown.setdefault(code, []).extend(made)
    return written


def render_suite(  # noqa: PLR0913  # what may be at hand already, beside what is asked for
    results: Sequence[Result],
    out: Path,
    formats: Collection[str],
    *,
    title: str = SUITE_TITLE,
    paper: Paper = "A4",
    spoken: str = ENGLISH,
    pdfs: Sequence[bytes | None] = (),
    shown: Mapping[str, list[View]] | None = None,
) -> list[Path]:
    """Write what binds several results together: index page, one PDF with contents, JUnit, summary.

    The index page holds all reports, so it can be handed on as a single file. `pdfs` are the certificates of
    the results, as far as they have been set on this paper and in this language, unsigned; `shown` are views
    of the results in their order, as `render` has made them: what they have drawn is not drawn again.
    """
    ids = [result.id for result in results]
    views = {
        code: made
        for code, made in (shown or {}).items()
        if [view.document.id for view in made] == ids and len({view.key for view in made}) == len(made)
    }
    known = next(iter(views.values()), None)
    results = [view.document for view in known] if known else [result.as_written() for result in results]
    if pdfs:
        made = views.get(spoken) or unique_views(results, spoken)
        views[spoken] = [_with_pdf(view, pdf) for view, pdf in zip(made, pdfs, strict=True)]
    return _write(results, views, out, formats, title=title, paper=paper, spoken=spoken)


def _with_pdf(view: View, pdf: bytes | None) -> View:
    """Return a view with its certificate; what was drawn stays drawn."""
    other = replace(view, pdf=pdf)
    vars(other).update(vars(view))
    return other


def repeatable(folder: Path) -> list[str]:
    """Return the reports in a folder that the document alone renders to, by their file names."""
    made = [report_format(name) for name in FORMATS]
    return [each.FILE for each in made if each.REPEATABLE and (folder / each.FILE).is_file()]


def rendered_again(result: Result, folder: Path) -> Iterator[tuple[str, bytes]]:
    """Yield the name and the bytes of each report in a folder that the document alone renders to.

    Parameters
    ----------
    result : Result
        The document, as it was read.
    folder : Path
        Holds the reports; they are read for their language alone.
    """
    there = repeatable(folder)
    for name in FORMATS:
        made = report_format(name)
        if made.FILE not in there:
            continue
        spoken = ENGLISH
        if made.TRANSLATED:
            spoken = import_module(FORMATS[name]).language_of((folder / made.FILE).read_bytes())
        content = made.write(unique_views([result], spoken), title=None, paper="A4") or b""
        yield made.FILE, content.encode() if isinstance(content, str) else content


def _write(  # what a format takes
    results: Sequence[Result],
    views: dict[str, list[View]],
    out: Path,
    formats: Collection[str],
    *,
    title: str | None,
    paper: Paper,
    spoken: str,
) -> list[Path]:
    """Write each format; views of a language that are missing are made, and stay in `views`."""
    written = []
    for name in checked(formats):
        made = report_format(name)
        file = made.FILE if title is None else made.SUITE_FILE
        if file is None:
            continue
        code = spoken if made.TRANSLATED else ENGLISH
        if code not in views:
            views[code] = unique_views(results, code)
        try:
            content = made.write(views[code], title=title, paper=paper)
        except MissingPartError as error:
            leave_out(file, error)
            continue
        if content is not None:
            write_whole(out / file, content)
            written.append(out / file)
    return written


def suite_again(results: Sequence[Result], form: str, content: bytes, folder: Path) -> bytes:
    """Render what binds several results again, in the language of what is there, under the suite's title.

    Parameters
    ----------
    results : sequence of Result
        As they were read, in their order.
    form : str
        Of `FORMATS`; a repeatable one.
    content : bytes
        What is there; read for its language alone.
    folder : Path
        The suite's, whose index page says the title that the suite was given.
    """
    made = report_format(form)
    spoken = ENGLISH
    if made.TRANSLATED:
        spoken = import_module(FORMATS[form]).language_of(content)
    again = made.write(unique_views(results, spoken), title=_title_in(folder), paper="A4") or b""
    return again.encode() if isinstance(again, str) else again


def _title_in(folder: Path) -> str:
    """Return the title that a suite's index page says; the usual one where there is none."""
    page = folder / "index.html"
    said = _TITLE.search(page.read_bytes()[:TITLE_BYTES]) if page.is_file() else None
    return SUITE_TITLE if said is None else html.unescape(said[1].decode("utf-8", "replace"))
