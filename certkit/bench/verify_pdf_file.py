"""Checks of a PDF as a file: what was appended to it, laid over its pages, or hidden in it."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from certkit.bench.pdf_words import plain_objects, words_outside_pages
from certkit.bench.verification import Check, fails, holds, unchecked

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from certkit.bench.pdf_pages import PdfPage

WHAT = "file"

END = re.compile(rb"startxref\s+\d+\s+%%EOF")

ACTIVE = (
    b"/JavaScript",
    b"/JS",
    b"/OpenAction",
    b"/AA",
    b"/Launch",
    b"/SubmitForm",
    b"/ImportData",
    b"/GoToR",
    b"/GoToE",
    b"/OCProperties",
    b"/XFA",
    b"/RichMedia",
    b"/Encrypt",
    b"/PieceInfo",
    b"/Alternates",
    b"/Thumb",
    b"/Trans",
    b"/OPI",
    b"/Collection",
    b"/UserUnit",
    b"/Movie",
    b"/Sound",
    b"/Rendition",
    b"/3D",
)
"""Names of what acts, leads away, is put aside, or shows other things to other readers."""


def revisions(content: bytes) -> list[int]:
    """Return where each writing of a PDF ends: one more for every incremental update."""
    return [match.end() for match in END.finditer(content)]


def first_revision(content: bytes) -> bytes:
    """Return the file as it was before anything was appended to it."""
    ends = revisions(content)
    return content[: ends[0]] + b"\n" if len(ends) > 1 else content


def file_checks(content: bytes, pages: Sequence[PdfPage], *, signatures: int) -> Iterator[Check]:
    """Name what was appended to a PDF, laid over its pages, or hidden in it.

    Parameters
    ----------
    content : bytes
        The file.
    pages : sequence of PdfPage
        Its pages, as it is now.
    signatures : int
        How many signatures it has: each is an update, and a form field that covers nothing.
    """
    found = [*_appended(content, signatures), *_laid_over(pages, signatures), *_active(content)]
    if found:
        yield from found
    else:
        yield holds(WHAT, "signature-update" if signatures else "file-structure-holds")


def update_checks(before: Sequence[PdfPage], now: Sequence[PdfPage]) -> Iterator[Check]:
    """Check that what was appended changes no page: same number, same words, same dots."""
    if len(before) != len(now):
        yield fails(WHAT, "pages-added-by-update", before=len(before), now=len(now))
        return
    for number, (old, new) in enumerate(zip(before, now, strict=True), 1):
        same = old.text == new.text and old.image.shape == new.image.shape
        if not same or not np.array_equal(old.image, new.image):
            yield fails(WHAT, "pages-changed-by-update", page=number)


def word_checks(content: bytes, made: bytes, *, same_engine: bool) -> Iterator[Check]:
    """Check that a PDF says nothing outside its pages that it does not say when it is made again.

    Another WeasyPrint, or so it is said, may say more.
    """
    added = sorted(words_outside_pages(content) - words_outside_pages(made))
    if added:
        yield (fails if same_engine else unchecked)(WHAT, "words-added", words=added[0][:80])


def _appended(content: bytes, signatures: int) -> Iterator[Check]:
    ends = revisions(content)
    if not ends:
        yield fails(WHAT, "bytes-appended", count=0)
        return
    if not content.startswith(b"%PDF-"):
        yield fails(WHAT, "bytes-before")
    rest = content[ends[-1] :].strip(b"\r\n")
    if rest:
        yield fails(WHAT, "bytes-appended", count=len(rest))
    updates = len(ends) - 1
    if updates > signatures:
        yield fails(WHAT, "update-appended", count=updates - signatures)


def _laid_over(pages: Sequence[PdfPage], signatures: int) -> Iterator[Check]:
    fields = 0
    for number, page in enumerate(pages, 1):
        for each in page.annotations:
            if each.kind == "form field":
                fields += 1
                if each.covers or fields > signatures:
                    yield fails(WHAT, "form-field", page=number)
            elif each.kind != "link":  # links within the file are usual
                yield fails(WHAT, "annotation", page=number, kind=each.kind)


def _active(content: bytes) -> Iterator[Check]:
    text = plain_objects(content)
    for key in ACTIVE:
        if re.search(re.escape(key) + rb"(?![A-Za-z0-9])", text):
            yield fails(WHAT, "active-content", key=key.decode())
