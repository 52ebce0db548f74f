"""Files that say two things of one test: an error with both places, never one of them in silence."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.definitions.channel_mapping import Mapping
from certkit.errors import DataError
from certkit.exchange.read import read_recording

if TYPE_CHECKING:
    from pathlib import Path

CHANNEL = "Channel/leg.001"
COOL = Mapping.model_validate({"mapping": "cool", "conditions": {"temperature": "20 degC"}})


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def append(path: Path, line: str) -> None:
    path.write_text(f"{path.read_text(encoding='utf-8')}{line}\n", encoding="utf-8")


def coded(mme: Path, letter: str, stated: str) -> Path:
    """Give T1 a filter letter in its code and a class in its header."""
    change(mme / "Channel/leg.chn", "D0TIBIUP00PFMOX0", f"D0TIBIUP00PFMOX{letter}")
    change(mme / CHANNEL, "D0TIBIUP00PFMOX0", f"D0TIBIUP00PFMOX{letter}")
    change(mme / CHANNEL, "frequency class      :NOVALUE", f"frequency class      :{stated}")
    return mme


@pytest.mark.parametrize(
    "line", ["Reference temperature        :35", "Comments                     :Temperature = 35 degC"]
)
def test_two_temperatures_are_an_error_with_both_lines(mme: Path, line: str):
    append(mme / "leg.mme", line)
    with pytest.raises(DataError, match=r"leg\.mme:\d+: .*leg\.mme:\d+|leg\.mme:\d+: .*in line \d+"):
        read_recording(mme)


def test_the_same_temperature_twice_is_no_contradiction(mme: Path):
    append(mme / "leg.mme", "Comments                     :temperature = 293.35 K")
    assert read_recording(mme).recording.conditions["temperature"] == pytest.approx(293.35)


@pytest.mark.parametrize("container", ["mme", "table"])
def test_data_and_mapping_must_agree_on_a_condition(container: str, request: pytest.FixtureRequest):
    path: Path = request.getfixturevalue(container)
    assert read_recording(path, COOL.model_copy(update={"conditions": {"temperature": "20.2 degC"}}))
    with pytest.raises(DataError, match=r"mapping `cool`, condition temperature: .* in .*leg\.(mme|csv)"):
        read_recording(path, COOL)


@pytest.mark.parametrize(
    ("letter", "stated"), [("0", "60"), ("0", "CFC_180"), ("C", "1000 Hz"), ("C", "none"), ("A", "CFC 60")]
)
def test_a_class_that_the_code_denies_is_an_error(mme: Path, letter: str, stated: str):
    coded(mme, letter, stated)
    with pytest.raises(DataError, match=r"leg\.001:10: .* but the code"):
        read_recording(mme)


def test_read_leniently_the_narrower_filter_counts_so_that_nothing_is_filtered_twice(mme: Path):
    read = read_recording(coded(mme, "0", "180"), lenient=True)
    assert read.recording["T1"].filtered == "CFC 180"
    assert "narrower" in str(read.assumptions[0])


def test_an_amplifier_of_1000_hz_is_told_and_no_contradiction(mme: Path):
    channel = read_recording(coded(mme, "0", "1000")).recording["T1"]
    assert channel.filtered == "CFC 1000"
    assert [note.code for note in channel.notes] == ["prefiltered"]


def test_a_class_in_words_is_asked_back(mme: Path):
    with pytest.raises(DataError, match=r"leg\.001:10: .* no class such as 180"):
        read_recording(coded(mme, "0", "as usual"))


@pytest.mark.parametrize("status", ["NOT OK", "failed", "bad", "channel failed at 40 ms", "scaling unknown"])
def test_a_status_that_is_not_good_takes_the_channel_out_and_is_told(mme: Path, status: str):
    change(mme / CHANNEL, ":ok", f":{status}")
    read = read_recording(mme).recording
    assert "T1" not in read
    assert "T2" in read
    assert read.notes[0].parameters["status"] == status
    assert str(read.notes[0].parameters["place"]).endswith("leg.001:20")


def test_a_doubtful_status_is_told(mme: Path):
    change(mme / CHANNEL, ":ok", ":Questionable Data")
    assert [note.code for note in read_recording(mme).recording["T1"].notes] == ["questionable-data"]


def test_a_test_whose_status_is_not_good_is_not_read(mme: Path, table: Path):
    append(mme / "leg.mme", "Data status                  :not ok")
    with pytest.raises(DataError, match=r"leg\.mme:\d+: data status of the test is `not ok`"):
        read_recording(mme)
    table.write_text(f"# data status: void\n{table.read_text(encoding='utf-8')}", encoding="utf-8")
    with pytest.raises(DataError, match=r"leg\.csv:1: data status is `void`"):
        read_recording(table)


def test_a_csv_channel_whose_status_is_not_good_is_not_used(table: Path):
    text = table.read_text(encoding="utf-8")
    table.write_text(f"# data status T1: channel failed\n{text}", encoding="utf-8")
    read = read_recording(table).recording
    assert "T1" not in read
    assert [note.code for note in read.notes] == ["status-not-good"]


def test_a_unit_behind_a_header_number_is_read(mme: Path):
    plain = read_recording(mme).recording
    for path in (mme / "Channel").glob("leg.0*"):
        change(path, "interval            :0.0001", "interval            :0.1 ms")
        change(path, "first sample         :-0.05", "first sample         :-50 ms")
    np.testing.assert_allclose(read_recording(mme).recording.time, plain.time, atol=1e-12)
    change(mme / CHANNEL, "interval            :0.1 ms", "interval            :0.1 mm")
    with pytest.raises(DataError, match=r"leg\.001:14: `Sampling interval`: .*`mm`"):
        read_recording(mme)


def test_an_amplitude_class_is_read_in_its_own_unit(mme: Path):
    path = mme / "Channel/leg.005"  # MCL, mm
    change(path, "amplitude class      :NOVALUE", "amplitude class      :0.03 m")
    assert "MCL" in read_recording(mme).recording
    change(path, "amplitude class      :0.03 m", "amplitude class      :0.003 m")
    with pytest.raises(DataError, match="amplitude class"):
        read_recording(mme)


def test_samples_must_reach_the_extremes_that_the_header_states(mme: Path):
    line = "First global maximum value   :{}\nData status"
    change(mme / CHANNEL, "Data status", line.format("252"))
    assert "T1" in read_recording(mme).recording
    change(mme / CHANNEL, ":252\n", ":253\n")
    with pytest.raises(DataError, match=r"leg\.001:\d+: .* is 253, but that of the samples is 250 Nm"):
        read_recording(mme)


def test_a_dimension_that_the_code_denies_is_an_error(mme: Path):
    change(mme / CHANNEL, ":Moment", ":Force")
    with pytest.raises(DataError, match=r"leg\.001:8: `Dimension` is `Force`"):
        read_recording(mme)


def test_a_direction_that_the_code_denies_is_an_error(mme: Path):
    change(mme / CHANNEL, "Direction                    :X", "Direction                    :Y")
    with pytest.raises(DataError, match=r"leg\.001:9: `Direction` is `Y`, but the code .* says X"):
        read_recording(mme)


def test_a_channel_of_another_object_is_an_error(mme: Path):
    change(mme / CHANNEL, "object number           :1", "object number           :2")
    with pytest.raises(DataError, match=r"leg\.001: belongs to test object 2, the other channels to 1"):
        read_recording(mme)


def test_a_channel_of_another_position_is_an_error(mme: Path):
    for file in ("Channel/leg.chn", CHANNEL):
        change(mme / file, "D0TIBIUP00PF", "D2TIBIUP00PF")
    with pytest.raises(DataError, match=r"position D2, the other channels to D0"):
        read_recording(mme)


def test_one_simulated_channel_among_measured_ones_is_an_error(mme: Path):
    change(mme / CHANNEL, ":transducer", ":simulation")
    with pytest.raises(
        DataError, match=r"leg\.001: `Data source` is `simulation`, but .*leg\.002 was measured"
    ):
        read_recording(mme)


def test_other_words_for_the_temperature_are_understood_in_comments(mme: Path):
    append(mme / "leg.mme", "Comments                     :Room temperature: 35 degC")
    with pytest.raises(DataError, match="temperature is 308"):
        read_recording(mme)


def test_a_line_above_the_heads_that_stands_twice_must_say_one_thing(table: Path):
    text = table.read_text(encoding="utf-8")
    table.write_text(f"# temperature: 308 K\n{text}", encoding="utf-8")
    with pytest.raises(DataError, match=r"leg\.csv:\d+: `temperature` is .* and `308 K` in line 1"):
        read_recording(table)
