"""Figures that stand alone, for slides and papers: SVG, and PNG made from the same drawing."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from certkit.documents.unverified import MARK, is_marked
from certkit.errors import UsageError
from certkit.reporting.figure_list import FIGURES
from certkit.reporting.svg import FONT, label

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.output_document import OutputDocument
    from certkit.reporting.svg import Drawing

FORMATS = ("svg", "png")


def figure(
    document: OutputDocument,
    what: str,
    form: str = "svg",
    *,
    channels: Sequence[str] = (),
    beside: OutputDocument | None = None,
) -> bytes:
    """Draw one figure of a document.

    Parameters
    ----------
    document : OutputDocument
        A result or an extraction.
    what : str
        A figure that `certkit.reporting.figure_list.FIGURES` has for it.
    form : {'svg', 'png'}
        SVG for pages, PNG at three pixels to each of the drawing's for slides.
    channels : sequence of str
        Only these channels, criteria or load paths; all by default.
    beside : OutputDocument, optional
        A second one of the same kind, for figures that show two: `history` lays curves over, `frames` draws
        its row below.

    Returns
    -------
    bytes
        The file's content.

    Raises
    ------
    UsageError
        When the figure, format or channel is unknown, or the document holds nothing to draw it from.
    """
    if form not in FORMATS:
        raise UsageError(f"unknown figure format `{form}`; use {' or '.join(FORMATS)}")
    drawing = drawn(document, what, channels, beside)
    if form == "svg":
        return f"{drawing}\n".encode()
    from certkit.reporting.raster import png  # noqa: PLC0415  # WeasyPrint and PDFium load for PNG alone

    return png(drawing)


def drawn(
    document: OutputDocument, what: str, names: Sequence[str] = (), beside: OutputDocument | None = None
) -> Drawing:
    """Return one figure of a document as a drawing; see `figure`."""
    known = FIGURES.get(document.schema_word())
    if known is None:
        raise UsageError(
            f"there are figures of results and extractions, not of a {document.noun}; name one of these"
        )
    if what not in known:
        raise UsageError(f"unknown figure `{what}` of a {document.noun}; use {', '.join(known)}")
    entry = known[what]
    if beside is None:
        drawing = _function(entry.draw)(document, names)
    elif entry.beside:
        drawing = _function(entry.beside)(document, beside, names)
    else:
        able = " and ".join(f"`{name}`" for name, each in known.items() if each.beside)
        raise UsageError(f"`{what}` cannot show two results; {able or 'no figure of it'} can")
    if drawing is None:
        raise UsageError(
            f"the {document.noun} holds nothing to draw `{what}` from; choose another with `--what`"
        )
    found: Drawing = drawing
    return _stamped(found) if is_marked(document, beside) else found


def _stamped(drawing: Drawing) -> Drawing:
    """Return a drawing that says across its top that its document was changed."""
    words = label(4, 11, MARK, font_size=11, font_weight=600, font_family=FONT, fill="#b00020")
    return replace(drawing, body=drawing.body + words)


def _function(place: str) -> Any:  # noqa: ANN401  # a drawing function of any document
    module, _, name = place.partition(":")
    return getattr(import_module(f"certkit.reporting.charts.{module}"), name)
