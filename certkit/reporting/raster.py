"""PNG from our own SVG: WeasyPrint sets it with the shipped font, PDFium paints it.

Both draw the certificate too, so a picture in a slide looks like the one in the PDF. cairosvg would need
the system's Cairo, matplotlib cannot read SVG; pypdfium2 is one wheel without dependencies.
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from certkit.reporting.pdf_engine import pdf_of_drawing

if TYPE_CHECKING:
    from certkit.reporting.svg import Drawing

SCALE = 3.0
"""Pixels for each pixel of the drawing: 288 dots an inch."""


def png(drawing: Drawing) -> bytes:
    """Paint a drawing on white."""
    import pypdfium2  # noqa: PLC0415  # only where a PNG is wanted

    document: Any = pypdfium2.PdfDocument(pdf_of_drawing(drawing))
    # A PDF's unit is 1/72 inch, a CSS pixel 1/96.
    image = document[0].render(scale=SCALE * 96 / 72).to_pil()
    stream = io.BytesIO()
    image.save(stream, "PNG", optimize=True)
    document.close()
    return stream.getvalue()
