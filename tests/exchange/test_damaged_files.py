"""Damaged measured data: each kind has its own one-line error that names the place."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from support.damage import DAMAGES

from certkit.errors import DataError
from certkit.exchange.read import read_recording

if TYPE_CHECKING:
    from pathlib import Path

    from support.damage import Damage


@pytest.mark.parametrize("damage", DAMAGES, ids=lambda d: d.name)
def test_damage_is_told_in_one_line_with_its_place(damage: Damage, mme: Path, table: Path):
    target = damage.do(mme if damage.container == "mme" else table)
    with pytest.raises(DataError, match=damage.says) as caught:
        read_recording(target)
    assert "\n" not in str(caught.value)
    assert "leg" in str(caught.value)


def test_there_are_many_kinds_of_damage():
    assert len({damage.says for damage in DAMAGES}) >= 25


def test_lenient_reading_lists_each_assumption(mme: Path):
    (mme / "Channel/leg.chn").unlink()
    channel = mme / "Channel/leg.001"
    channel.write_text(
        channel.read_text().replace("Number of samples            :2500", "Number of samples            :9")
    )
    with pytest.raises(DataError, match="--lenient"):
        read_recording(mme)
    read = read_recording(mme, lenient=True)
    assert len(read.assumptions) == 2
    assert any("no channel list" in str(a) for a in read.assumptions)
    assert any("9 samples announced" in str(a) for a in read.assumptions)
    assert set(read.assumptions) <= set(read.recording.notes)


def test_two_time_bases_are_brought_together_only_when_lenient(mme: Path):
    channel = mme / "Channel/leg.001"
    channel.write_text(channel.read_text().replace(":0.0001\n", ":0.0002\n"))
    read = read_recording(mme, lenient=True)
    assert read.recording.interval == pytest.approx(1e-4)
    assert "two time bases" in str(read.assumptions[0])


def test_a_channel_with_a_gap_is_left_out_only_when_lenient(mme: Path, table: Path):
    channel = mme / "Channel/leg.001"
    lines = channel.read_text().split("\n")
    channel.write_text("\n".join([*lines[:700], "NOVALUE", *lines[701:]]))
    rows = table.read_text(encoding="utf-8").split("\n")
    cells = rows[90].split(",")
    rows[90] = ",".join([cells[0], "", *cells[2:]])
    table.write_text("\n".join(rows), encoding="utf-8")
    for path in (mme, table):
        with pytest.raises(DataError, match="a sample is missing"):
            read_recording(path)
        read = read_recording(path, lenient=True)
        assert "T1" not in read.recording
        assert "T2" in read.recording
        assert read.assumptions[0].parameters["channel"] == "T1"


def test_a_gap_in_time_cannot_be_let_pass(table: Path):
    rows = table.read_text(encoding="utf-8").split("\n")
    rows[90] = rows[90][rows[90].index(",") :]
    table.write_text("\n".join(rows), encoding="utf-8")
    with pytest.raises(DataError, match=r"leg\.csv:91: a sample is missing"):
        read_recording(table, lenient=True)
