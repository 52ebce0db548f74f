"""What a report format is: a module with the names of its files and a function that makes their content."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.reporting.result_view import View

Paper = Literal["A4", "Letter"]
"""Page sizes of a PDF."""


class ReportFormat(Protocol):
    """A module of `certkit.reporting.writing.FORMATS`.

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
