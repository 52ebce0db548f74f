"""A slide to draw on: native forms, marks and labels in units of the drawing's own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from msgspec import Struct

from certkit.reporting.slide_parts import paint, pptx_part, write_words

if TYPE_CHECKING:
    from collections.abc import Sequence


class Canvas(Struct, frozen=True):
    """A slide to draw on, in units of its own.

    Parameters
    ----------
    shapes : object
        Of the slide.
    x, y : float
        EMU of the origin; the second axis points upward.
    scale : float
        EMU a unit.
    """

    shapes: Any
    x: float
    y: float
    scale: float

    def form(self, points: Sequence[tuple[float, float]], fill: str, edge: str) -> None:
        """Draw a closed form, or a line where it has no colour."""
        places = [(round(self.x + self.scale * a), round(self.y - self.scale * b)) for a, b in points]
        builder = self.shapes.build_freeform(*places[0], scale=1.0)
        builder.add_line_segments(places[1:], close=bool(fill))
        paint(builder.convert_to_shape(), fill, edge)

    def mark(self, form: str, place: tuple[float, float], size: float, fill: str) -> None:
        """Draw one of the program's own shapes around a place."""
        kind = getattr(pptx_part("pptx.enum.shapes").MSO_SHAPE, form)
        wide = round(self.scale * size)
        left, top = self.x + self.scale * place[0] - wide / 2, self.y - self.scale * place[1] - wide / 2
        paint(self.shapes.add_shape(kind, round(left), round(top), wide, wide), fill, "#ffffff")

    def label(self, text: str, place: tuple[float, float], colour: str, *, letters: int = 9) -> None:
        """Write a short text around a place, in letters of so many points."""
        wide, tall = round(9000 * letters * len(text)), 16000 * letters
        left, top = self.x + self.scale * place[0] - wide / 2, self.y - self.scale * place[1] - tall / 2
        frame = self.shapes.add_textbox(round(left), round(top), wide, tall).text_frame
        frame.margin_left = frame.margin_right = frame.margin_top = frame.margin_bottom = 0
        frame.vertical_anchor = pptx_part("pptx.enum.text").MSO_ANCHOR.MIDDLE
        frame.word_wrap = False
        frame.paragraphs[0].alignment = pptx_part("pptx.enum.text").PP_ALIGN.CENTER
        write_words(frame.paragraphs[0], text, letters, colour=colour)
