"""Checks of what lies beside a document: page, table, JUnit file and summary are what it renders to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.bench.verification import Check, judged, unchecked
from certkit.bench.verify_document import of_another_certkit, table_check
from certkit.exchange.container import read_bounded

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from certkit.documents.result import Result


def report_checks(folder: Path, result: Result) -> Iterator[Check]:
    """Check the files of a run's folder against its document; another version may render otherwise."""
    table = folder / "channels.csv"
    if table.is_file():
        yield table_check("channels.csv", read_bounded(table), result)
    from certkit.reporting.html_report import language_of, page  # noqa: PLC0415  # jinja2 only where needed
    from certkit.reporting.junit import junit  # noqa: PLC0415  # likewise
    from certkit.reporting.markdown import summary  # noqa: PLC0415  # likewise

    makers: dict[str, Callable[[], str | bytes]] = {
        "report.html": lambda: page(result, language_of(read_bounded(folder / "report.html"))),
        "junit.xml": lambda: junit([result]),
        "summary.md": lambda: summary([result]),
    }
    for name, make in makers.items():
        if not (folder / name).is_file():
            continue
        if of_another_certkit(result):
            version = result.provenance.certkit
            yield unchecked(name, "made-by-another-version", version=version, now=__version__)
            continue
        made = make()
        same = read_bounded(folder / name) == (made.encode() if isinstance(made, str) else made)
        yield judged(name, same, "rendering-differs")
