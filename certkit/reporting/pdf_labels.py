"""Texts of drawings on the pages of a PDF, each set once in a document.

This is the one place that uses what WeasyPrint does not call public: how it sets a line and shows its glyphs.
"""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Any, NamedTuple

from msgspec import Struct, field

if TYPE_CHECKING:
    from collections.abc import Callable


class Label(NamedTuple):
    """A text that was set: what shows it from the place of the text matrix on, and its width in pixels."""

    operators: list[Any]
    width: float


class Labels(Struct):
    """The texts of all drawings of one document.

    Parameters
    ----------
    fonts : FontConfiguration
        That the document is set with.
    family : str
        Names of fonts as in CSS.
    """

    fonts: Any
    family: str
    _set: dict[tuple[str, float, int], Label] = field(default_factory=dict)

    def label(self, stream: Any, words: str, size: float, weight: int) -> Label:  # noqa: ANN401  # no types
        """Return a text in a size (pixels) and weight; `stream` is the page's, which learns of its glyphs."""
        key = (words, size, weight)
        if key not in self._set:
            self._set[key] = self._new(stream, words, size, weight)
        return self._set[key]

    def _new(self, stream: Any, words: str, size: float, weight: int) -> Label:  # noqa: ANN401  # likewise
        make = engine()
        style = make.style(make.initial)
        style.font_config = self.fonts
        style["font_family"] = [name.strip(" \"'") for name in self.family.split(",")]
        style["font_size"], style["font_weight"] = size, weight
        layout = make.layout(words, style, None, inf, 0)
        width, _ = make.extent(layout.get_first_line()[0], style)
        own = stream.clone()
        make.show(own, make.box(layout, style), "none", "none", make.upright)
        return Label(own.stream[1:], width)  # without the text matrix, which comes first


class _Engine(NamedTuple):
    """Parts of WeasyPrint."""

    style: Any
    initial: Any
    box: Any
    layout: Callable[..., Any]
    extent: Callable[..., tuple[float, float]]
    show: Callable[..., Any]
    upright: Any


def engine() -> _Engine:
    """Return the parts of WeasyPrint that set a text.

    Raises
    ------
    ImportError
        When this WeasyPrint has not all of them.
    """
    from weasyprint.css.properties import INITIAL_VALUES  # noqa: PLC0415  # only where there is a PDF
    from weasyprint.draw.text import draw_first_line  # noqa: PLC0415  # likewise
    from weasyprint.matrix import Matrix  # noqa: PLC0415  # likewise
    from weasyprint.svg.text import Style, TextBox  # noqa: PLC0415  # likewise
    from weasyprint.text.line_break import create_layout, line_size  # noqa: PLC0415  # likewise

    return _Engine(Style, INITIAL_VALUES, TextBox, create_layout, line_size, draw_first_line, Matrix(d=-1))
