"""Pages of a PDF as text, images and annotations, by PDFium, which is made for files nobody vouches for."""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from certkit.errors import DataError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MOST_PAGES = 500
"""A suite of eight certificates has about sixty."""

LARGEST_SIDE = 2000.0
"""Points; Letter is 792 high."""

LUMINANCE = (29, 150, 77)
"""Of blue, green and red, in 256ths."""

ANNOTATIONS = {1: "note", 2: "link", 3: "free text", 13: "stamp", 17: "attachment", 20: "form field"}
"""Names of kinds of annotations by PDFium's numbers; others are called annotation."""


class Annotation(Struct, frozen=True):
    """Something laid over a page: its kind, and whether it covers any of it."""

    kind: str
    covers: bool


class PdfPage(Struct, frozen=True):
    """One page: size in points, its words, grey values at 72 dots an inch, and what is laid over it.

    The colours of all dots are kept as a digest.
    """

    width: float
    height: float
    text: str
    image: NDArray[np.uint8]
    colours: bytes
    annotations: tuple[Annotation, ...]


def pdf_pages(content: bytes, name: str) -> list[PdfPage]:
    """Return the pages of a PDF.

    Raises
    ------
    DataError
        When it cannot be opened, or has more or larger pages than any certificate.
    """
    import pypdfium2  # noqa: PLC0415  # only where a PDF is verified

    try:
        document: Any = pypdfium2.PdfDocument(content)
        try:
            if len(document) > MOST_PAGES:
                raise DataError(
                    f"{name}: {len(document)} pages; this is no certificate of certkit"
                    "; name one that certkit wrote"
                )
            return [_page(document[index], name) for index in range(len(document))]
        finally:
            document.close()
    except pypdfium2.PdfiumError as error:
        raise DataError(f"{name}: not a whole PDF ({error}); take the file as it was handed over") from error


def _page(page: Any, name: str) -> PdfPage:  # noqa: ANN401  # pypdfium2 has no types
    width, height = page.get_size()
    if max(width, height) > LARGEST_SIDE:
        raise DataError(
            f"{name}: a page of {width:.0f} x {height:.0f} points; this is no certificate"
            "; name a certificate that certkit wrote"
        )
    words = page.get_textpage()
    text = " ".join(words.get_text_range().split())
    words.close()
    import numpy as np  # noqa: PLC0415  # only where a PDF is verified

    dots = page.render(scale=1.0, draw_annots=True).to_numpy()[..., :3]
    grey = (dots @ np.array(LUMINANCE, dtype=np.uint16) >> 8).astype(np.uint8)
    colours = hashlib.sha256(dots.tobytes()).digest()
    found = PdfPage(width, height, text, grey, colours, _annotations(page))
    page.close()
    return found


def _annotations(page: Any) -> tuple[Annotation, ...]:  # noqa: ANN401  # likewise
    import ctypes  # noqa: PLC0415  # beside its only use

    import pypdfium2.raw as pdfium  # noqa: PLC0415  # likewise

    found = []
    for index in range(pdfium.FPDFPage_GetAnnotCount(page)):
        annotation = pdfium.FPDFPage_GetAnnot(page, index)
        box = pdfium.FS_RECTF()
        pdfium.FPDFAnnot_GetRect(annotation, ctypes.byref(box))
        kind = ANNOTATIONS.get(pdfium.FPDFAnnot_GetSubtype(annotation), "annotation")
        covers = abs(box.right - box.left) > 0.5 and abs(box.top - box.bottom) > 0.5
        found.append(Annotation(kind, covers))
        pdfium.FPDFPage_CloseAnnot(annotation)
    return tuple(found)
