"""Slides (extra `pptx`): tables and native charts on the user's own template; same input, same bytes."""

from __future__ import annotations

import io
import os
import re
import zipfile
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import TYPE_CHECKING, Any

from certkit.documents.unverified import MARK, is_marked
from certkit.errors import UsageError
from certkit.exchange.csv_cells import harmless
from certkit.plain_text import without_odd_characters
from certkit.reporting.palette import PENS, VERDICT
from certkit.reporting.slide_canvas import Canvas
from certkit.reporting.slide_parts import pptx_part, rgb, set_font, write_words
from certkit.reporting.workbook import Tinted, shown

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from certkit.documents.output_document import OutputDocument
    from certkit.reporting.workbook import Cell

TEMPLATE = "CERTKIT_PPTX_TEMPLATE"
"""Environment variable with a presentation whose master and layouts the slides take."""

MADE = "1980-01-01T00:00:00Z"
"""The date that every file inside says it was made on."""

MOST_ROWS = 14
"""Lines of a table on one slide."""

WIDE, HIGH = 12192000, 6858000
"""EMU of a slide without a template: 16 to 9."""

_template: ContextVar[Path | None] = ContextVar("slide template", default=None)


@contextmanager
def on_template(path: Path | None) -> Iterator[None]:
    """Let slides that are made inside take the look of a presentation."""
    token = _template.set(path)
    try:
        yield
    finally:
        _template.reset(token)


class SlideDeck:
    """A presentation that is being made.

    Raises
    ------
    MissingPartError
        When python-pptx is not installed.
    UsageError
        When the template cannot be read.
    """

    def __init__(self, document: OutputDocument | None) -> None:
        """Open an empty presentation, on the template where there is one.

        Of a document that was changed, every slide says so.
        """
        self._before = f"{MARK}: " if is_marked(document) else ""
        pptx = pptx_part("pptx")
        named = os.environ.get(TEMPLATE)
        path = _template.get() or (Path(named) if named else None)
        try:
            self._deck = pptx.Presentation(None if path is None else str(path))
        except Exception as error:  # python-pptx raises whatever its parts do
            raise UsageError(
                f"{path}: no presentation that slides can be made on ({error}); name a .pptx file"
            ) from error
        if path is None:
            self._deck.slide_width, self._deck.slide_height = WIDE, HIGH
        self._own = path is None

    def title(self, title: str, lines: Sequence[str]) -> None:
        """Add a slide with a title and lines below it."""
        slide = self._slide(title)
        left, top, width, height = self._area()
        frame = slide.shapes.add_textbox(left, top, width, height).text_frame
        frame.word_wrap = True
        for index, line in enumerate(lines):
            paragraph = frame.paragraphs[0] if index == 0 else frame.add_paragraph()
            write_words(
                paragraph, line, 18 if index == 0 else 14, colour=VERDICT.get(line.split(":")[0].lower(), "")
            )

    def table(self, title: str, heads: Sequence[str], rows: Sequence[Sequence[Cell]]) -> None:
        """Add a table, on as many slides as it takes."""
        for first in range(0, max(len(rows), 1), MOST_ROWS):
            part = rows[first : first + MOST_ROWS]
            slide = self._slide(title if first == 0 else f"{title} (continued)")
            left, top, width, height = self._area()
            tall = min(height, (len(part) + 1) * 330000)
            table = slide.shapes.add_table(len(part) + 1, len(heads), left, top, width, tall).table
            for column, share in enumerate(_widths([heads, *part])):
                table.columns[column].width = int(share * width)
            for line, cells in enumerate([heads, *part]):
                for column, cell in enumerate(cells):
                    text, colour = shown(cell), cell.colour if isinstance(cell, Tinted) else ""
                    frame = table.cell(line, column).text_frame
                    write_words(
                        frame.paragraphs[0], text, 11, colour=colour or VERDICT.get(text, ""), bold=line == 0
                    )

    def columns(
        self, title: str, names: Sequence[str], series: Mapping[str, Sequence[float | None]], unit: str
    ) -> None:
        """Add a native column chart: a group of columns a name."""
        data = pptx_part("pptx.chart.data").CategoryChartData()
        data.categories = [harmless(name) for name in names]
        for name, values in series.items():
            data.add_series(harmless(name), [None if v is None else float(f"{v:.7g}") for v in values])
        self._chart(
            title, pptx_part("pptx.enum.chart").XL_CHART_TYPE.COLUMN_CLUSTERED, data, len(series), ("", unit)
        )

    def lines(
        self, title: str, x: Sequence[float], series: Mapping[str, Sequence[float]], titles: tuple[str, str]
    ) -> None:
        """Add a native chart of lines over numbers."""
        data = pptx_part("pptx.chart.data").XyChartData()
        for name, values in series.items():
            line = data.add_series(harmless(name))
            for a, b in zip(x, values, strict=True):
                line.add_data_point(float(f"{a:.7g}"), float(f"{b:.7g}"))
        self._chart(
            title,
            pptx_part("pptx.enum.chart").XL_CHART_TYPE.XY_SCATTER_LINES_NO_MARKERS,
            data,
            len(series),
            titles,
        )

    def canvas(self, title: str, low: tuple[float, float], high: tuple[float, float]) -> Canvas:
        """Add a slide to draw on, with a scale for both axes that shows the range from `low` to `high`."""
        slide = self._slide(title)
        left, top, width, height = self._area()
        scale = min(width / (high[0] - low[0]), height / (high[1] - low[1]))
        middle = left + width / 2 - scale * (low[0] + high[0]) / 2
        return Canvas(slide.shapes, middle, top + height + scale * low[1], scale)

    def content(self) -> bytes:
        """Return the presentation's bytes."""
        stream = io.BytesIO()
        self._deck.save(stream)
        return repacked(stream.getvalue())

    def _slide(self, title: str) -> Any:  # noqa: ANN401  # python-pptx has no types
        layouts = list(self._deck.slide_layouts)
        with_title = [
            each for each in layouts if any(p.placeholder_format.type == 1 for p in each.placeholders)
        ]
        plain = min(with_title or layouts, key=lambda each: len(each.placeholders))
        slide = self._deck.slides.add_slide(plain)
        shape = slide.shapes.title
        if shape is None:
            shape = slide.shapes.add_textbox(457200, 274638, int(self._deck.slide_width) - 914400, 800000)
        if self._own:
            shape.left, shape.top, shape.width, shape.height = 457200, 274638, WIDE - 914400, 800000
        shape.text_frame.word_wrap = True
        said = title if title.startswith(MARK) else f"{self._before}{title}"
        shape.text_frame.text = without_odd_characters(said)
        if self._own:
            set_font(shape.text_frame.paragraphs[0], 26, "#16202c", bold=True)
            shape.text_frame.paragraphs[0].alignment = pptx_part("pptx.enum.text").PP_ALIGN.LEFT
        return slide

    def _area(self) -> tuple[int, int, int, int]:
        """Return where the body of a slide goes: left, top, width, height."""
        width, height = int(self._deck.slide_width), int(self._deck.slide_height)
        return int(0.04 * width), int(0.19 * height), int(0.92 * width), int(0.75 * height)

    def _chart(self, title: str, kind: Any, data: Any, count: int, titles: tuple[str, str]) -> None:  # noqa: ANN401  # likewise
        points = pptx_part("pptx.util").Pt
        slide = self._slide(title)
        chart = slide.shapes.add_chart(kind, *self._area(), data).chart
        chart.has_title = False
        chart.font.size = points(12)
        chart.has_legend = count > 1
        if count > 1:
            chart.legend.position = pptx_part("pptx.enum.chart").XL_LEGEND_POSITION.BOTTOM
            chart.legend.include_in_layout = False
        for index, series in enumerate(chart.plots[0].series):
            colour = rgb(PENS[index % len(PENS)].colour)
            if "XY" in str(kind):
                series.format.line.color.rgb = colour
                series.format.line.width = points(1.75)
                if index >= len(PENS):
                    dashes = pptx_part("pptx.enum.dml").MSO_LINE
                    worn = (dashes.DASH, dashes.SQUARE_DOT, dashes.LONG_DASH_DOT, dashes.LONG_DASH)
                    series.format.line.dash_style = worn[(index // len(PENS) - 1) % len(worn)]
                series.smooth = False
            else:
                series.format.fill.solid()
                series.format.fill.fore_color.rgb = colour
        for axis, words in zip((chart.category_axis, chart.value_axis), titles, strict=True):
            axis.has_title = bool(words)
            if words:
                axis.axis_title.text_frame.text = without_odd_characters(words)
        chart.category_axis.has_major_gridlines = False
        chart.category_axis.tick_label_position = pptx_part("pptx.enum.chart").XL_TICK_LABEL_POSITION.LOW
        chart.value_axis.has_major_gridlines = True
        chart.value_axis.major_gridlines.format.line.color.rgb = rgb("#d5dbe1")


def _widths(rows: Sequence[Sequence[Cell]]) -> list[float]:
    """Return the share of the width that each column takes, by its longest text."""
    longest = [max(7, *(min(30, len(shown(row[i]))) + 2 for row in rows)) for i in range(len(rows[0]))]
    return [letters / sum(longest) for letters in longest]


def repacked(content: bytes) -> bytes:
    """Return an Office file with one fixed date on and in all of its parts, also of the workbooks inside."""
    made = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as new:
        for item in old.infolist():
            data = old.read(item)
            if item.filename.endswith(".xlsx"):
                data = repacked(data)
            elif item.filename == "docProps/core.xml":
                data = re.sub(rb"(<dcterms:(?:created|modified)[^>]*>)[^<]*", rb"\g<1>" + MADE.encode(), data)
            fixed = zipfile.ZipInfo(item.filename, (1980, 1, 1, 0, 0, 0))
            fixed.compress_type, fixed.create_system = zipfile.ZIP_DEFLATED, 3
            new.writestr(fixed, data)
    return made.getvalue()
