"""The report formats of a result: a module each, with the names of its files and what makes their content.

A format is one file beside this one, and one line in `FORMATS`: writing, the commands' help and `verify` ask
here. The module is imported when it is asked for: JUnit must not wait for jinja2.
"""

from __future__ import annotations

from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Literal, Protocol, cast

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.reporting.result_view import View

FORMATS = MappingProxyType(
    {
        "csv": "certkit.reporting.csv_report",
        "junit": "certkit.reporting.junit",
        "md": "certkit.reporting.markdown",
        "xlsx": "certkit.reporting.xlsx_report",
        "pptx": "certkit.reporting.pptx_report",
        "dcc": "certkit.reporting.dcc_report",
        "html": "certkit.reporting.html_report",
        "pdf": "certkit.reporting.pdf_report",
    }
)
"""The module of each format, a `ReportFormat`; the cheapest first."""

Paper = Literal["A4", "Letter"]
"""Page sizes of a PDF."""


class ReportFormat(Protocol):
    """A module of `FORMATS`.

    Parameters
    ----------
    FILE, SUITE_FILE : str or None
        Its file for one result, and for several; None where there is none.
    TRANSLATED : bool
        Whether its words are those of the wanted language; others are English. A module that is both this
        and repeatable has `language_of(content)`.
    REPEATABLE : bool
        Whether `verify` renders it again from the document and compares the bytes.
    """

    FILE: str
    SUITE_FILE: str | None
    TRANSLATED: bool
    REPEATABLE: bool

    def write(self, views: Sequence[View], *, title: str | None, paper: Paper) -> str | bytes | None:
        """Return the content for one result, or for a suite of that title; None where there is nothing."""


def report_format(name: str) -> ReportFormat:
    """Return the module of a format."""
    return cast("ReportFormat", import_module(FORMATS[name]))
