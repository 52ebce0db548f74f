"""The numbers that went in, as rows on paper: name, value, confidence and source.

Hundreds of them are most lines of a certificate. As a cell of a table each took the typesetter ten times as
long as a text of a drawing does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.number_format import shortened
from certkit.reporting.svg import Drawing, label, tag

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

ROWS = 4
"""In one drawing: a page ends between two of them."""

WIDTH, HEIGHT = 665.0, 16.5
"""CSS pixels: as wide as A4 between its margins, and one row."""

VALUE, ORIGIN = 520.0, 532.0
LONGEST_NAME, LONGEST_VALUE = 58, 40
SIZE = 10.67


def number_rows(rows: Sequence[tuple[str, str, str, int]], word: Callable[[str], str]) -> Iterator[Drawing]:
    """Draw rows of name, value, confidence and number of the source.

    Parameters
    ----------
    rows : sequence of tuple
    word : callable
        Translates the word of a confidence.

    Yields
    ------
    Drawing
        Of class `rows`, a few rows in each; text, not a figure.
    """
    for first in range(0, len(rows), ROWS):
        some = rows[first : first + ROWS]
        drawn = ""
        if first == 0:
            drawn += tag("line", x1=0, y1=0, x2=WIDTH, y2=0, stroke=palette.LINE, stroke_width=1)
        for place, (name, value, confidence, source) in enumerate(some):
            y = HEIGHT * place + 12
            # With a space behind each: whoever copies the text, or has it read aloud, gets words apart.
            drawn += label(0, y, f"{shortened(name, LONGEST_NAME)} ")
            drawn += label(VALUE, y, f"{shortened(value, LONGEST_VALUE)} ", text_anchor="end")
            drawn += label(ORIGIN, y, f"{word(confidence)} [{source}] ")
        said = "; ".join(f"{name} {value}" for name, value, *_ in some)
        yield Drawing(
            WIDTH, HEIGHT * len(some), tag("g", drawn, font_size=SIZE), said, css_class="rows", role="text"
        )
