"""Pages, sheets and PDFs that are named where the document is wanted that they are made of."""

from __future__ import annotations

from certkit.errors import DataError

NO_DOCUMENT = (
    "is no document of certkit's; pages, tables and sheets are made of one"
    ": name that (result.json, …), or the folder that it lies in"
)


def refuse_papers(text: str, name: str) -> None:
    """Refuse a PDF, a page or a zipped sheet.

    Raises
    ------
    DataError
        That says what to name instead.
    """
    if text.startswith(("%PDF", "PK", "<")):
        raise DataError(f"{name}: {NO_DOCUMENT}")
