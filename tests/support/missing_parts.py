"""What this machine lacks: tests that need it are skipped with one clear line, here and nowhere else.

Only what is truly missing excuses a test: where Pango is installed, an error that says otherwise is a fault.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest

from certkit.errors import LeftOutWarning, MissingPartError
from certkit.reporting.pdf_engine import weasyprint

PANGO = "the Pango library is not installed: nothing can be set as PDF or drawn as PNG"


@cache
def pango_is_missing() -> bool:
    """Tell whether WeasyPrint finds no Pango."""
    try:
        weasyprint()
    except MissingPartError:
        return True
    return False


def excuse(error: BaseException | None) -> str:
    """Return why a test that ended with this error could not be made here; empty where it is a fault."""
    while error is not None:
        if isinstance(error, (MissingPartError, LeftOutWarning)) and "Pango" in str(error):
            return PANGO if pango_is_missing() else ""
        error = error.__cause__ or error.__context__
    return ""


def skipped(report: Any, item: pytest.Item, reason: str) -> None:  # noqa: ANN401  # pytest names no type
    """Make a report that of a skipped test."""
    report.outcome = "skipped"
    report.longrepr = (str(item.path), item.location[1] or 0, f"Skipped: {reason}")
