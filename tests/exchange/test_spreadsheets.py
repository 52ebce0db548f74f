"""Tables as spreadsheets and loggers write them: read as they are meant, or refused with line and remedy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.definitions.channel_mapping import Mapping
from certkit.errors import DataError
from certkit.exchange.read import read_recording

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

Rows = list[str]

NAMES = ("T1", "T2", "T3", "T4", "MCL", "ACL", "PCL")
SHEET = {
    "mapping": "sheet",
    "csv": {
        "delimiter": ";",
        "decimal": ",",
        "time": {"column": "time", "unit": "s"},
        "columns": {name: {"column": name, "unit": "mm" if "L" in name else "N·m"} for name in NAMES},
    },
}
MAPPING = Mapping.model_validate(SHEET)


def german(own: str) -> str:
    """Write certkit's own table as a German spreadsheet does."""
    return own.replace(",", ";").replace(".", ",")


def bare(table: Path) -> Rows:
    """Return heads without units and rows, with semicolons and decimal commas."""
    rows = [row for row in table.read_text(encoding="utf-8").split("\n") if not row.startswith("#")]
    return [";".join(["time", *NAMES]), *german("\n".join(rows[1:])).split("\n")]


def test_our_own_table_saved_by_a_german_spreadsheet_is_read(table: Path):
    plain = read_recording(table).recording
    head, rows = table.read_text(encoding="utf-8").split("time [s]")
    remarks = "".join(f'"{line}";;;;;;;\r\n' for line in head.splitlines())
    text = "\ufeff" + remarks + german(f"time [s]{rows}").replace("\n", "\r\n")
    table.write_bytes(text.encode())
    read = read_recording(table).recording
    for name in NAMES:
        np.testing.assert_array_equal(read[name].values, plain[name].values)
    assert read.conditions == plain.conditions


WAYS: dict[str, Callable[[Rows], str]] = {
    "plain": "\n".join,
    "quoted": lambda rows: "\n".join(";".join(f'"{cell}"' for cell in row.split(";")) for row in rows if row),
    "a delimiter at each line end": lambda rows: "\n".join(f"{row};" for row in rows if row),
    "delimiters after the rows alone": lambda rows: "\n".join(
        [rows[0], *(f"{row};;" for row in rows[1:] if row)]
    ),
    "carriage returns twice": "\r\r\n".join,
    "a byte order mark": lambda rows: "\ufeff" + "\n".join(rows),
    "empty rows at the end": lambda rows: "\n".join([*rows, ";;;;;;;", ";;;;;;;", ""]),
    "the delimiter named": lambda rows: "\n".join(["sep=;", *rows]),
    "a row of units": lambda rows: "\n".join([rows[0], "[s];Nm;Nm;Nm;Nm;mm;mm;mm", *rows[1:]]),
    "blanks around the cells": lambda rows: "\n".join(row.replace(";", " ; ") for row in rows),
}


@pytest.mark.parametrize("way", WAYS)
def test_what_a_spreadsheet_adds_changes_nothing(way: str, table: Path):
    plain = read_recording(table).recording
    table.write_bytes(WAYS[way](bare(table)).encode())
    read = read_recording(table, MAPPING).recording
    for name in NAMES:
        np.testing.assert_array_equal(read[name].values, plain[name].values)


def test_a_row_of_units_below_bare_heads_is_read_without_a_mapping(table: Path):
    plain = read_recording(table).recording
    rows = bare(table)
    table.write_text("\n".join([rows[0], "s;kNm;Nm;Nm;Nm;mm;mm;mm", *rows[1:]]), encoding="utf-8")
    read = read_recording(table).recording
    np.testing.assert_allclose(read["T1"].values, 1e3 * plain["T1"].values)
    np.testing.assert_array_equal(read["T2"].values, plain["T2"].values)


def edited(table: Path, number: int, change: Callable[[str], str]) -> None:
    rows = bare(table)
    rows[number - 1] = change(rows[number - 1])
    table.write_text("\n".join(rows), encoding="utf-8")


def with_cell(column: int, cell: str) -> Callable[[str], str]:
    def change(row: str) -> str:
        cells = row.split(";")
        cells[column - 1] = cell
        return ";".join(cells)

    return change


@pytest.mark.parametrize("cell", ["4.848", "1.234,5"])
def test_a_thousands_point_is_refused(cell: str, table: Path):
    edited(table, 700, with_cell(2, cell))
    with pytest.raises(DataError, match=rf"leg\.csv:700: `{cell}` has a point .*thousands.*\(column 2\)"):
        read_recording(table, MAPPING)


def test_a_date_in_a_column_that_nobody_asks_for_is_let_be(table: Path):
    rows = bare(table)
    rows = [f"{rows[0]};day", *(f"{row};12.03.2026" for row in rows[1:] if row)]
    table.write_text("\n".join(rows), encoding="utf-8")
    assert set(read_recording(table, MAPPING).recording.channels) == set(NAMES)


def test_an_empty_line_between_samples_is_refused_with_its_own_line(table: Path):
    edited(table, 201, lambda row: f"\n{row}")
    with pytest.raises(DataError, match=r"leg\.csv:201: an empty line"):
        read_recording(table, MAPPING)


def test_a_quoted_cell_that_holds_the_delimiter_is_refused(table: Path):
    rows = table.read_text(encoding="utf-8").split("\n")
    rows[90] = rows[90].replace(",", ',"4,848",', 1)
    table.write_text("\n".join(rows), encoding="utf-8")
    with pytest.raises(DataError, match=r"leg\.csv:91: `4,848` holds the delimiter"):
        read_recording(table)


@pytest.mark.parametrize(
    ("units", "place"),
    [
        ("s;kNm;Nm;Nm;Nm;mm;mm;mm", "T1 is in kNm here, in N·m"),
        ("ms;Nm;Nm;Nm;Nm;mm;mm;mm", "time is in ms here"),
    ],
)
def test_a_unit_of_the_table_that_the_mapping_denies_is_an_error(units: str, place: str, table: Path):
    rows = bare(table)
    table.write_text("\n".join([rows[0], units, *rows[1:]]), encoding="utf-8")
    with pytest.raises(DataError, match=rf"leg\.csv:2: {place}"):
        read_recording(table, MAPPING)


def test_lines_above_the_heads_count_with_a_mapping_too(table: Path):
    rows = ["# kind: simulated", "# filter T1: CFC 180", *bare(table)]
    table.write_text("\n".join(rows), encoding="utf-8")
    own = {**SHEET["csv"], "head": 3}
    with pytest.raises(DataError, match=r"leg\.csv:2: T1 was filtered with CFC 180, the mapping says none"):
        read_recording(table, Mapping.model_validate({**SHEET, "csv": own}))
    own["columns"] = {**own["columns"], "T1": {"column": "T1", "unit": "N·m", "filter": "CFC 180"}}
    assert read_recording(table, Mapping.model_validate({**SHEET, "csv": own})).recording.kind == "simulated"
