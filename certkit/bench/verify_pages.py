"""Check of a certificate's pages: rendered again from what is attached, and compared."""

from __future__ import annotations

import re
from difflib import SequenceMatcher
from importlib.metadata import version
from typing import TYPE_CHECKING, Self

import numpy as np
from msgspec import Struct

from certkit._version import __version__
from certkit.bench.pdf_pages import pdf_pages
from certkit.bench.verification import Check, fails, holds, unchecked
from certkit.errors import CertkitError
from certkit.reporting.writing import SUITE_TITLE

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from certkit.bench.pdf_attachments import Attached
    from certkit.bench.pdf_pages import PdfPage
    from certkit.documents.legform_certificate import LegformCertificate
    from certkit.documents.result import Result

WHAT = "pages"


def _of_another_version(results: Sequence[Result]) -> Check | None:
    others = [r.provenance.certkit for r in results if r.provenance.certkit != __version__]
    if others:
        return unchecked(WHAT, "pages-of-another-version", version=others[0], now=__version__)
    return None


def certificate_again(document: LegformCertificate, attached: Attached) -> bytes | Check:
    """Return the PDF that a legform's certificate renders to, or why it cannot be rendered."""
    others = _of_another_version(document.results)
    if others:
        return others
    from certkit.reporting.legform_certificate_report import certificate_pdf  # noqa: PLC0415  # WeasyPrint, 1 s

    try:
        return certificate_pdf(
            document, paper=attached.paper, spoken=attached.language, created=attached.created
        )
    except CertkitError as error:
        return unchecked(WHAT, "pages-not-renderable", error=" ".join(str(error).split()))


def rendered_again(results: Sequence[Result], attached: Attached) -> bytes | Check:
    """Return the PDF that the attached documents render to, or why it cannot be rendered."""
    others = _of_another_version(results)
    if others:
        return others
    from certkit.reporting.pdf_report import certificate  # noqa: PLC0415  # WeasyPrint takes a second
    from certkit.reporting.result_view import unique_views  # noqa: PLC0415  # likewise

    title = attached.title if attached.title is not None else SUITE_TITLE if len(results) > 1 else None
    try:
        return certificate(
            unique_views(results, attached.language),
            paper=attached.paper,
            title=title,
            created=attached.created,
        )
    except CertkitError as error:
        return unchecked(WHAT, "pages-not-renderable", error=" ".join(str(error).split()))


class Printed(Struct, frozen=True):
    """What a PDF should be: how it renders again, or why it cannot; its ids; the WeasyPrints that made it."""

    made: bytes | Check
    ids: tuple[str, ...]
    engines: frozenset[str]
    several: bool = False

    @classmethod
    def of(cls, results: Sequence[Result], made: bytes | Check, ids: Sequence[str] = ()) -> Self:
        """Return it for results, or for what has an id of its own and was made of them."""
        engines = frozenset(result.provenance.packages.get("weasyprint", "") for result in results)
        own = tuple(ids or [result.id for result in results])
        return cls(made, own, engines, several=len(own) > 1)

    @property
    def same_engine(self) -> bool:
        """Tell whether the WeasyPrint that made it is the one that is installed."""
        return self.engines == {version("weasyprint")}


def page_checks(content: bytes, pages: Sequence[PdfPage], printed: Printed) -> Iterator[Check]:
    """Check that the pages are what the attached documents render to.

    Parameters
    ----------
    content : bytes
        The file as it is, or as it was before it was signed.
    pages : sequence of PdfPage
        Its pages.
    printed : Printed
        What they should be.
    """
    made = printed.made
    blank = [number for number, page in enumerate(pages, 1) if not page.text and page.image.min() > 250]
    if isinstance(made, Check):
        yield from (fails(WHAT, "page-blank", page=number) for number in blank)
        for number, page in enumerate(pages, 1):
            contents = printed.several and number == 1
            if number not in blank and not contents and not any(each in page.text for each in printed.ids):
                yield fails(WHAT, "page-foreign", page=number)
        yield made
        return
    if content.rstrip(b"\r\n") == made.rstrip(b"\r\n"):
        yield holds(WHAT, "pages-same-bytes")
        return
    wanted = pdf_pages(made, WHAT)
    if len(pages) != len(wanted):
        yield from (fails(WHAT, "page-blank", page=number) for number in blank)
        yield fails(WHAT, "page-count", said=len(pages), made=len(wanted))
        return
    installed = version("weasyprint")
    recorded = printed.engines
    found = list(_compared(pages, wanted, "" if recorded == {installed} else ", ".join(sorted(recorded))))
    if found:
        yield from found
    elif recorded == {installed}:
        yield unchecked(WHAT, "pages-rewritten")
    else:
        yield holds(WHAT, "pages-same-look")


def _compared(said: Sequence[PdfPage], made: Sequence[PdfPage], engine: str) -> Iterator[Check]:
    """Compare size, words and dots of every page; `engine` is another WeasyPrint that made them."""
    for number, (is_, should) in enumerate(zip(said, made, strict=True), 1):
        if abs(is_.width - should.width) > 0.5 or abs(is_.height - should.height) > 0.5:
            yield fails(WHAT, "page-size", page=number)
            continue
        if is_.text != should.text:
            before, after = _first_difference(is_.text, should.text)
            yield fails(WHAT, "page-text", page=number, said=before, made=after)
            continue
        place = _other_dots(is_, should)
        if place and engine:
            # Which WeasyPrint made it is no part of the id, so a forger may name any.
            yield unchecked(WHAT, "page-picture-other-engine", page=number, place=place, version=engine)
        elif place:
            yield fails(WHAT, "page-picture", page=number, place=place)


def _first_difference(said: str, made: str) -> tuple[str, str]:
    """Return the words where two texts first differ."""
    old, new = (re.findall(r"\S+", text) for text in (said, made))
    for word, i, j, k, m in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if word != "equal":
            return " ".join(old[i : min(j, i + 8)]), " ".join(new[k : min(m, k + 8)])
    return said[:40], made[:40]


def _other_dots(said: PdfPage, made: PdfPage) -> str:
    """Return where two images differ, in millimetres from the upper left corner; empty where nowhere."""
    if said.image.shape != made.image.shape:
        return "its edges"
    other = said.image != made.image
    if not other.any():
        return "" if said.colours == made.colours else "its colours"
    down, across = (values.mean() * 25.4 / 72 for values in np.nonzero(other))
    return f"{across:.0f} mm across, {down:.0f} mm down"
