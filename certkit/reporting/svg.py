"""A small SVG writer: elements as text, escaped on the way, and `Drawing`, a figure with its size.

The same figures stand in HTML and PDF, so they are made once as plain SVG. matplotlib would do it too, but
its import alone took 0.96 s and eleven figures 540 KB; these cost some milliseconds and 30 KB.
"""

from __future__ import annotations

import unicodedata
from html import escape
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting.palette import INK

if TYPE_CHECKING:
    from collections.abc import Iterable

FONT = "IBM Plex Sans, system-ui, sans-serif"


def number(value: float) -> str:
    """Write a coordinate: two decimals at most, no trailing zeros, no minus zero."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text in {"-0", ""} else text


def tag(element: str, content: str = "", **attributes: float | str | None) -> str:
    """Write one element. `content` is markup that is already escaped; attributes with None are left out.

    Underscores in attribute names become hyphens, a trailing one is dropped (`class_`).
    """
    parts = [element]
    for key, value in attributes.items():
        if value is None:
            continue
        name = key if key == "viewBox" else key.rstrip("_").replace("_", "-")
        text = value if isinstance(value, str) else number(value)
        parts.append(f'{name}="{escape(text)}"')
    head = " ".join(parts)
    return f"<{head}>{content}</{element}>" if content else f"<{head}/>"


def label(x: float, y: float, words: str, **attributes: float | str | None) -> str:
    """Write a text at a point."""
    return tag("text", escape(words), x=x, y=y, **attributes)


def letters(words: str) -> float:
    """Return how many Latin letters a text is as wide as; an East Asian sign counts 1.75."""
    return sum(1.75 if unicodedata.east_asian_width(sign) in "WF" else 1.0 for sign in words)


def path(points: Iterable[tuple[float, float]], *, closed: bool = False) -> str:
    """Return path data through points, relative and in tenths of a pixel to stay short."""
    data: list[str] = []
    last_x = last_y = 0
    for index, (x, y) in enumerate(points):
        at_x, at_y = round(x * 10), round(y * 10)
        step = f"{number((at_x - last_x) / 10)} {number((at_y - last_y) / 10)}"
        data.append(("M" if index == 0 else "l") + step)
        last_x, last_y = at_x, at_y
    return "".join(data) + ("z" if closed else "")


class Drawing(Struct, frozen=True):
    """A drawing with its size, so that it can be placed in another one; a template shows it as it is.

    Parameters
    ----------
    width, height : float
        CSS pixels.
    body : str
        Drawn elements, from `tag`, `label` and `path`.
    title : str
        Text alternative.
    css_class : str
        What style sheets and scripts know it by.
    role : str
        `img` for what is only looked at; `group` for one with links in it.
    """

    width: float
    height: float
    body: str
    title: str
    css_class: str = "figure"
    role: str = "img"

    def svg(self, *, x: float | None = None, y: float | None = None) -> str:
        """Return the SVG element; with a place, as a part of another drawing."""
        return tag(
            "svg",
            tag("title", escape(self.title)) + self.body,
            x=x,
            y=y,
            xmlns="http://www.w3.org/2000/svg",
            viewBox=f"0 0 {number(self.width)} {number(self.height)}",
            width=self.width,
            height=self.height,
            class_=self.css_class,
            role=self.role,
            aria_label=self.title,
            font_family=FONT,
            font_size="11",
            fill=INK,
        )

    def __html__(self) -> str:
        """Return the SVG for a template."""
        return self.svg()

    def __str__(self) -> str:
        """Return the SVG as text."""
        return self.svg()
