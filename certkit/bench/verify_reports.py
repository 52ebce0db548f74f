"""Checks of what lies beside a document: page, table, JUnit file and summary are what it renders to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit._version import __version__
from certkit.bench.verification import Check, judged, left_out, unchecked
from certkit.bench.verify_document import of_another_certkit, table_check
from certkit.files.bounded import read_bounded

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from certkit.documents.result import Result


def report_checks(folder: Path, result: Result) -> Iterator[Check]:
    """Check the files of a run's folder against its document; another version may render otherwise."""
    table = folder / "channels.csv"
    if table.is_file():
        yield table_check("channels.csv", read_bounded(table), result)
    from certkit.reporting.writing import rendered_again, repeatable  # noqa: PLC0415  # where there is a folder

    for name in ("report.xlsx", "report.pptx"):
        if (folder / name).is_file():
            yield left_out(name, "not-compared")

    if of_another_certkit(result):
        version = result.provenance.certkit
        for name in repeatable(folder):
            yield unchecked(name, "made-by-another-version", version=version, now=__version__)
        return
    for name, made in rendered_again(result, folder):
        yield judged(name, read_bounded(folder / name) == made, "rendering-differs")
