"""Workbooks for spreadsheets (extra `xlsx`): tables and native charts; same input, same bytes."""

from __future__ import annotations

import io
import re
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any, NamedTuple

from msgspec import Struct

from certkit.documents.unverified import MARK, is_marked
from certkit.errors import MissingPartError
from certkit.exchange.csv_cells import harmless
from certkit.reporting.palette import PENS, VERDICT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.output_document import OutputDocument

MADE = datetime(1980, 1, 1, tzinfo=UTC)
"""The date that every workbook says it was made on: a clock would make each one different."""

_DASHES = ("solid", "dash", "square_dot", "long_dash_dot", "long_dash")
"""Of lines, one after the other when all colours are used up."""

LONGEST_NAME = 31
"""Letters of a sheet's name that a spreadsheet takes."""


class Tinted(NamedTuple):
    """A cell in a colour of its own."""

    value: str | float | None
    colour: str


Cell = str | float | None | Tinted


class TablePlace(Struct, frozen=True):
    """Where a table stands: its sheet, its head's row, its number of rows."""

    sheet: str
    head: int
    count: int

    def column(self, number: int) -> list[Any]:
        """Return the reference of a column's values."""
        return [self.sheet, self.head + 1, number, self.head + max(self.count, 1), number]

    def name(self, number: int) -> list[Any]:
        """Return the reference of a column's head."""
        return [self.sheet, self.head, number]


class SheetBook:
    """A workbook that is being made.

    Texts are written as texts: none of them can begin a formula, whoever wrote it.

    Raises
    ------
    MissingPartError
        When XlsxWriter is not installed.
    """

    def __init__(self, title: str, document: OutputDocument | None) -> None:
        """Open a workbook in memory; of a document that was changed, every sheet says so."""
        self._above = (MARK,) if is_marked(document) else ()
        try:
            import xlsxwriter  # noqa: PLC0415  # an extra
        except ImportError as error:
            raise MissingPartError(
                "it needs XlsxWriter; install it with `pip install certkit[xlsx]`"
            ) from error
        self._stream = io.BytesIO()
        plain = {"strings_to_formulas": False, "strings_to_urls": False, "strings_to_numbers": False}
        self._book = xlsxwriter.Workbook(
            self._stream, {"in_memory": True, "nan_inf_to_errors": False, **plain}
        )
        self._book.set_properties({"title": title, "author": "certkit", "created": MADE})
        self._sheets: dict[str, Any] = {}
        self._forms: dict[tuple[str, str], Any] = {}

    def table(
        self,
        name: str,
        heads: Sequence[str],
        rows: Sequence[Sequence[Cell]],
        *,
        above: Sequence[str] = (),
        number: str = "0.###",
    ) -> TablePlace:
        """Write a sheet with lines of text and a table below.

        Parameters
        ----------
        name : str
            Of the sheet; brought to what a spreadsheet takes.
        heads : sequence of str
        rows : sequence of sequence of Cell
            A number as a number, a text as a text; None stays empty.
        above : sequence of str
            The first of them large.
        number : str
            Format of numbers.
        """
        above = [*self._above, *above]
        key = self._name(name)
        sheet = self._book.add_worksheet(key)
        self._sheets[key] = sheet
        sheet.hide_gridlines(2)
        for line, text in enumerate(above):
            form = self._form("title") if line == 0 else self._form("note")
            sheet.write_string(line, 0, harmless(text), form)
        head = len(above) + 1 if above else 0
        for column, text in enumerate(heads):
            sheet.write_string(head, column, harmless(text), self._form("head"))
        for line, row in enumerate(rows, head + 1):
            for column, cell in enumerate(row):
                self._write(sheet, line, column, cell, number)
        for column, text in enumerate(heads):
            longest = max([len(text), *(len(shown(row[column])) for row in rows if column < len(row))])
            sheet.set_column(column, column, min(60.0, longest + 2.5))
        sheet.freeze_panes(head + 1, 1)
        if rows:
            sheet.autofilter(head, 0, head + len(rows), len(heads) - 1)
        return TablePlace(key, head, len(rows))

    def chart(
        self,
        kind: str,
        title: str,
        place: TablePlace,
        columns: Sequence[int],
        *,
        titles: tuple[str, str] = ("", ""),
        at: tuple[int, int] = (1, 1),
    ) -> None:
        """Put a native chart onto a table's sheet.

        Parameters
        ----------
        kind : {'line', 'column', 'bar'}
            Lines over numbers, or bars over names.
        title : str
        place : TablePlace
        columns : sequence of int
            Columns of the table that are drawn over its first one.
        titles : (str, str)
            Of both axes.
        at : (int, int)
            Row and column of the chart's corner.
        """
        options = {"type": "scatter", "subtype": "straight"} if kind == "line" else {"type": kind}
        chart = self._book.add_chart(options)
        for index, column in enumerate(columns):
            colour, dash = PENS[index % len(PENS)].colour, _DASHES[index // len(PENS) % len(_DASHES)]
            series: dict[str, Any] = {
                "name": place.name(column),
                "categories": place.column(0),
                "values": place.column(column),
            }
            series |= (
                {"line": {"color": colour, "width": 1.5, "dash_type": dash}}
                if kind == "line"
                else {"fill": {"color": colour}}
            )
            chart.add_series(series)
        chart.set_title({"name": harmless(title), "name_font": {"size": 12}, "overlay": False})
        chart.set_x_axis({"name": titles[0], "label_position": "low", "major_gridlines": {"visible": False}})
        chart.set_y_axis(
            {"name": titles[1], "major_gridlines": {"visible": True, "line": {"color": "#e3e8ed"}}}
        )
        chart.set_legend({"position": "bottom"} if len(columns) > 1 else {"none": True})
        tall = 24 * place.count if kind == "bar" else 0
        chart.set_size({"width": 760, "height": max(360, tall)})
        self._sheets[place.sheet].insert_chart(at[0], at[1], chart)

    def content(self) -> bytes:
        """Close the workbook and return its bytes."""
        self._book.close()
        return self._stream.getvalue()

    def _name(self, wanted: str) -> str:
        plain = re.sub(r"[\[\]:*?/\\']", " ", harmless(wanted)).strip()[:LONGEST_NAME] or "sheet"
        name, number = plain, 1
        while name.casefold() in {known.casefold() for known in self._sheets}:
            number += 1
            name = f"{plain[: LONGEST_NAME - 4]} {number}"
        return name

    def _write(self, sheet: Any, line: int, column: int, cell: Cell, number: str) -> None:  # noqa: ANN401  # XlsxWriter has no types
        colour = ""
        if isinstance(cell, Tinted):
            cell, colour = cell
        if isinstance(cell, int | float):
            sheet.write_number(line, column, cell, self._form("number", colour or number))
        elif cell:
            sheet.write_string(
                line, column, harmless(cell), self._form("text", colour or VERDICT.get(cell, ""))
            )

    def _form(self, role: str, more: str = "") -> Any:  # noqa: ANN401  # likewise
        if (role, more) not in self._forms:
            roles: dict[str, dict[str, Any]] = {
                "title": {"bold": True, "font_size": 16},
                "note": {"font_color": "#536070"},
                "head": {
                    "bold": True,
                    "bg_color": "#e3e8ed",
                    "bottom": 1,
                    "text_wrap": True,
                    "valign": "bottom",
                },
                "number": {"num_format": "0.###"},
                "text": {},
            }
            looks = roles[role]
            if more.startswith("#"):
                looks = looks | {"font_color": more, "bold": True}
            elif more:
                looks = looks | {"num_format": more}
            self._forms[role, more] = self._book.add_format(looks)
        return self._forms[role, more]


def shown(cell: Cell) -> str:
    """Return a cell as a text."""
    value = cell.value if isinstance(cell, Tinted) else cell
    return f"{value:.5g}" if isinstance(value, int | float) else value or ""
