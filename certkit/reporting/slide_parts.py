"""What slides are made with: the modules of python-pptx (extra `pptx`), texts, colours."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from certkit.errors import MissingPartError
from certkit.plain_text import without_odd_characters


def pptx_part(name: str) -> Any:  # noqa: ANN401  # python-pptx has types for half of what it does
    """Return a module of python-pptx, which is an extra."""
    try:
        return import_module(name)
    except ImportError as error:
        raise MissingPartError("it needs python-pptx; install it with `pip install certkit[pptx]`") from error


def write_words(paragraph: Any, text: str, size: int, *, colour: str = "", bold: bool = False) -> None:  # noqa: ANN401  # likewise
    """Add a text to a paragraph, in a size and, where one is named, a colour."""
    run = paragraph.add_run()
    run.text = without_odd_characters(text)
    set_font(run, size, colour, bold=bold or bool(colour))


def set_font(part: Any, size: int, colour: str, *, bold: bool) -> None:  # noqa: ANN401  # likewise
    """Set the size, weight and colour of a text."""
    part.font.size = pptx_part("pptx.util").Pt(size)
    part.font.bold = bold or None
    if colour:
        part.font.color.rgb = rgb(colour)


def rgb(colour: str) -> Any:  # noqa: ANN401  # likewise
    """Return a colour such as `#0072b2` as the library wants it."""
    return pptx_part("pptx.dml.color").RGBColor.from_string(colour.lstrip("#").upper())


def paint(shape: Any, fill: str, edge: str) -> None:  # noqa: ANN401  # likewise
    """Fill a shape, or leave it empty, and colour its edge."""
    if fill:
        shape.fill.solid()
        shape.fill.fore_color.rgb = rgb(fill)
    else:
        shape.fill.background()
    shape.line.color.rgb = rgb(edge)
    shape.shadow.inherit = False
