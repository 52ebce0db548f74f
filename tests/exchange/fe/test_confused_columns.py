"""Titles that stand twice, columns that moved, files that are not the one named: told, never guessed."""

from __future__ import annotations

import gzip
import importlib.util
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.errors import DataError
from certkit.exchange.fe.histories import parse_units
from certkit.exchange.fe.radioss import part_histories
from certkit.exchange.fe.readers.ls_dyna_binout import read_binout
from certkit.exchange.fe.readers.openradioss_csv import read_converted
from certkit.exchange.fe.readers.openradioss_native import read_native

if TYPE_CHECKING:
    from collections.abc import Callable

    from certkit.exchange.fe.histories import PartHistories

BUMPER = Path(__file__).parents[3] / "examples/extract/bumper-reference"
UNITS = parse_units("kg mm ms")

needs_lasso = pytest.mark.skipif(importlib.util.find_spec("lasso") is None, reason="needs lasso-python")


def converted(path: Path) -> PartHistories:
    return part_histories(read_converted(path), UNITS, {})


def edited(folder: Path, change: Callable[[list[list[str]]], None]) -> Path:
    """Write the converted history with its cells changed."""
    rows = [
        r.split(",")
        for r in gzip.decompress((BUMPER / "time-history.csv.gz").read_bytes()).decode().split("\n")
    ]
    change(rows)
    path = folder / "time-history.csv"
    path.write_text("\n".join(",".join(row) for row in rows))
    return path


def column(rows: list[list[str]], ending: str) -> int:
    return next(i for i, head in enumerate(rows[0]) if " ".join(head.strip('"').split()).endswith(ending))


def test_two_parts_of_one_title_are_both_kept_and_told_apart(tmp_path: Path):
    content = gzip.decompress((BUMPER / "time-history.T01.gz").read_bytes())
    path = tmp_path / "run.T01"
    path.write_bytes(content.replace(b"back_beam", b"fascia   ", 1))
    parts = part_histories(read_native(path), UNITS, {})
    twins = [name for name in parts.parts if name.startswith("fascia")]
    assert len(twins) == 2
    with pytest.raises(DataError, match=r"`fascia` is the title of 2 parts; .*fascia \(id \d+\)"):
        parts.part("fascia")
    assert parts.part(twins[0]).mass != parts.part(twins[1]).mass


def test_a_control_character_in_a_head_hides_no_column(tmp_path: Path):
    def mark(rows: list[list[str]]) -> None:
        at = column(rows, "fascia-foam FNX")
        rows[0][at] = rows[0][at].rstrip('"') + '\x13"'

    plain = converted(edited(tmp_path, lambda _: None)).contact("fascia-foam").impulse
    np.testing.assert_array_equal(converted(edited(tmp_path, mark)).contact("fascia-foam").impulse, plain)


def shift(ending: str, by: int) -> Callable[[list[list[str]]], None]:
    """Move all columns from one on to the right, as the converter does; zeros come in, the last are lost."""

    def change(rows: list[list[str]]) -> None:
        at = column(rows, ending)
        for row in rows[1:]:
            if len(row) > at:
                end = row[-1:] if not row[-1].strip() else []
                cells = row[: len(row) - len(end)]
                row[:] = [*cells[:at], *["0"] * by, *cells[at : len(cells) - by], *end]

    return change


@pytest.mark.parametrize("begin", ["foam IE", "fascia IE", "fascia MASS", "impactor-fascia FNX"])
def test_columns_that_the_converter_shifted_by_six_are_refused(tmp_path: Path, begin: str):
    with pytest.raises(DataError, match=r"columns may be shifted|a converter leaves them that shifts"):
        converted(edited(tmp_path, shift(begin, 6)))


@pytest.mark.parametrize("factor", [0.0, 10.0])
def test_a_mass_that_its_momentum_denies_is_refused(tmp_path: Path, factor: float):
    def scaled(rows: list[list[str]]) -> None:
        at = column(rows, "fascia MASS")
        for row in rows[1:]:
            if len(row) > at:
                row[at] = f"{factor * float(row[at]):.9g}"

    with pytest.raises(DataError, match="momentum, mass and velocity of `fascia`"):
        converted(edited(tmp_path, scaled))


def test_impulses_where_forces_should_be_are_refused(tmp_path: Path):
    def summed(rows: list[list[str]]) -> None:
        at = column(rows, "fascia-foam FNX")
        total = 0.0
        for row in rows[1:]:
            if len(row) > at:
                total += float(row[at]) * 0.05
                row[at] = f"{total:.9g}"

    with pytest.raises(DataError, match=r"contact `fascia-foam` ends on .* as an impulse"):
        converted(edited(tmp_path, summed))


def test_columns_that_nothing_is_known_of_are_named(tmp_path: Path):
    def odd(rows: list[list[str]]) -> None:
        rows[0][column(rows, "fascia-foam FTY")] = '"var 17"'

    assert any("not read" in note and "var 17" in note for note in converted(edited(tmp_path, odd)).notes)


@needs_lasso
def test_brackets_in_a_path_are_no_pattern(tmp_path: Path):
    for name in ("run[1]", "run1"):
        (tmp_path / name).mkdir()
    shutil.copy(BUMPER / "bumper.binout0000", tmp_path / "run[1]/binout0000")
    (tmp_path / "run1/binout0000").write_bytes(b"\x08 not this one")
    read = read_binout(tmp_path / "run[1]/binout0000", UNITS, {})
    plain = read_binout(BUMPER / "bumper.binout0000", UNITS, {})
    np.testing.assert_array_equal(read.part("fascia").momentum, plain.part("fascia").momentum)
    assert list(read.files) == [str(tmp_path / "run[1]/binout0000")]
    assert list(read.files.values()) == list(plain.files.values())
