"""Damaged measured data: each kind has its own one-line error that names the place."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from damage import DAMAGES

from certkit.errors import DataError
from certkit.exchange.read import read_recording

if TYPE_CHECKING:
    from pathlib import Path

    from damage import Damage


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
    assert any("no channel list" in a for a in read.assumptions)
    assert any("9 samples announced" in a for a in read.assumptions)
    assert set(read.assumptions) <= set(read.recording.notes)


def test_two_time_bases_are_brought_together_only_when_lenient(mme: Path):
    channel = mme / "Channel/leg.001"
    channel.write_text(channel.read_text().replace(":0.0001\n", ":0.0002\n"))
    read = read_recording(mme, lenient=True)
    assert read.recording.interval == pytest.approx(1e-4)
    assert "two time bases" in read.assumptions[0]
