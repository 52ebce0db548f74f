"""Checks of a PDF as a file: what was appended to it, laid over its pages, or hidden in it."""

from __future__ import annotations

import re
import zlib
from typing import TYPE_CHECKING

import numpy as np

from certkit.bench.verification import Check, fails, holds

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
)
"""Names of what acts, leads away, or shows other things to other readers."""

MOST_UNPACKED = 64_000_000
"""Bytes of unpacked objects that are looked through."""

_STREAM = re.compile(rb"stream\r?\n")


def revisions(content: bytes) -> list[int]:
    """Return where each writing of a PDF ends: one more for every incremental update."""
    return [match.end() for match in END.finditer(content)]


def first_revision(content: bytes) -> bytes:
    """Return the file as it was before anything was appended to it."""
    ends = revisions(content)
    return content[: ends[0]] + b"\n" if len(ends) > 1 else content


def file_checks(
    content: bytes, pages: Sequence[PdfPage], *, signatures: int = 0, links: bool = True
) -> Iterator[Check]:
    """Name what was appended to a PDF, laid over its pages, or hidden in it.

    Parameters
    ----------
    content : bytes
        The file.
    pages : sequence of PdfPage
        Its pages, as it is now.
    signatures : int
        How many signatures it has: each is an update, and a form field that covers nothing.
    links : bool
        Whether links within the file are usual.
    """
    found = [*_appended(content, signatures), *_laid_over(pages, signatures, links=links), *_active(content)]
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
        same = old.text == new.text and old.picture.shape == new.picture.shape
        if not same or not np.array_equal(old.picture, new.picture):
            yield fails(WHAT, "pages-changed-by-update", page=number)


def _appended(content: bytes, signatures: int) -> Iterator[Check]:
    ends = revisions(content)
    if not ends:
        yield fails(WHAT, "bytes-appended", count=0)
        return
    rest = content[ends[-1] :].strip(b"\r\n")
    if rest:
        yield fails(WHAT, "bytes-appended", count=len(rest))
    updates = len(ends) - 1
    if updates > signatures:
        yield fails(WHAT, "update-appended", count=updates - signatures)


def _laid_over(pages: Sequence[PdfPage], signatures: int, *, links: bool) -> Iterator[Check]:
    fields = 0
    for number, page in enumerate(pages, 1):
        for each in page.annotations:
            if each.kind == "form field":
                fields += 1
                if each.covers or fields > signatures:
                    yield fails(WHAT, "form-field", page=number)
            elif not (links and each.kind == "link"):
                yield fails(WHAT, "annotation", page=number, kind=each.kind)


def _active(content: bytes) -> Iterator[Check]:
    text = _plain_objects(content)
    for key in ACTIVE:
        if re.search(re.escape(key) + rb"(?![A-Za-z0-9])", text):
            yield fails(WHAT, "active-content", key=key.decode())


def _plain_objects(content: bytes) -> bytes:
    """Return all dictionaries of a file: those between its streams, and those packed in object streams."""
    parts: list[bytes] = []
    place, room = 0, MOST_UNPACKED
    for match in _STREAM.finditer(content):
        if match.start() < place:
            continue
        head = content[place : match.start()]
        parts.append(head)
        end = content.find(b"endstream", match.end())
        end = len(content) if end < 0 else end
        if b"/ObjStm" in head[-2000:] and room > 0:
            unpacked = _inflated(content[match.end() : end], room)
            room -= len(unpacked)
            parts.append(unpacked)
        place = end
    parts.append(content[place:])
    joined = b"\n".join(parts)
    return re.sub(rb"#([0-9A-Fa-f]{2})", lambda found: bytes([int(found[1], 16)]), joined)


def _inflated(data: bytes, most: int) -> bytes:
    try:
        return zlib.decompressobj().decompress(data, most)
    except zlib.error:
        return b""
