"""Documents that were changed since certkit wrote them: refused, or marked on everything made of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from certkit.documents.output_document import OutputDocument

    Document = TypeVar("Document", bound=OutputDocument)

MARK = "UNVERIFIED"
"""Stands for the id of a changed document, and before its title, on every page, picture and table of it."""


def trusted(document: Document, name: str, *, unverified: bool = False) -> Document:
    """Return a document whose content makes its id.

    Parameters
    ----------
    document : OutputDocument
    name : str
        The file, for the message.
    unverified : bool
        Take a changed one as well, marked as such.

    Raises
    ------
    DataError
        When it was changed and that is not allowed.
    """
    if not unverified:
        document.check_id(name)
        return document
    return document if document.content_id() == document.id else marked(document)


def marked(document: Document) -> Document:
    """Return the document with `MARK` in the place of its id and before its title."""
    changes = {"id": MARK}
    for field in ("title", "serial"):
        if field in type(document).model_fields:
            changes[field] = f"{MARK}: {getattr(document, field)}"
    return document.model_copy(update=changes)


def is_marked(*documents: OutputDocument | None) -> bool:
    """Tell whether one of several documents is marked."""
    return any(document is not None and document.id == MARK for document in documents)
