"""What is written is read again: channels, units, conditions, and the same bytes every time."""

from __future__ import annotations

import json
import os
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from msgspec.structs import replace
from support.curves import write_csv

from certkit.definitions.channel_mapping import Mapping
from certkit.definitions.loading.channel_tables import default_channels
from certkit.errors import DataError, UsageError
from certkit.exchange.channels_csv import csv_text
from certkit.exchange.codes import code_table
from certkit.exchange.csv_read import read_csv
from certkit.exchange.mme_write import write_mme
from certkit.exchange.read import read_recording

if TYPE_CHECKING:
    from certkit.signals import Recording


def same(read: Recording, written: Recording) -> None:
    assert set(read.channels) == set(written.channels)
    np.testing.assert_allclose(read.time, written.time, atol=1e-9)
    for name, channel in written.channels.items():
        np.testing.assert_allclose(read[name].values, channel.values, rtol=1e-8, atol=1e-12)
        assert read[name].filtered == channel.filtered
    assert read.conditions == pytest.approx(dict(written.conditions))
    assert read.kind == written.kind


@pytest.mark.parametrize("name", ["test", "test.zip", "test.csv"])
@pytest.mark.parametrize("kind", ["measured", "simulated"])
def test_a_recording_survives_writing_and_reading(name: str, kind: str, recording: Recording, tmp_path: Path):
    channels = dict(recording.channels)
    channels["T1"] = replace(channels["T1"], filtered="CFC 180")
    written = replace(recording, kind=kind, channels=channels)
    target = tmp_path / name
    (write_csv if name.endswith(".csv") else write_mme)(written, target)
    same(read_recording(target).recording, written)


def test_the_same_recording_makes_the_same_archive(recording: Recording, tmp_path: Path):
    write_mme(recording, tmp_path / "a.zip", test="t")
    write_mme(recording, tmp_path / "b.zip", test="t")
    assert (tmp_path / "a.zip").read_bytes() == (tmp_path / "b.zip").read_bytes()


def test_an_existing_folder_is_not_written_over(recording: Recording, tmp_path: Path):
    (tmp_path / "test").mkdir()
    with pytest.raises(UsageError, match="exists"):
        write_mme(recording, tmp_path / "test")
    assert list(tmp_path.iterdir()) == [tmp_path / "test"]


def test_a_value_cannot_smuggle_a_header_line_in(recording: Recording, tmp_path: Path):
    write_mme(recording, tmp_path / "test", header={"Title": "x\nReference temperature :99"})
    assert read_recording(tmp_path / "test").recording.conditions["temperature"] == pytest.approx(293.35)


def test_the_master_file_may_be_named_instead_of_its_folder(mme: Path):
    assert "T1" in read_recording(mme / "leg.mme").recording


def test_descriptors_and_comments_become_conditions(mme: Path):
    master = mme / "leg.mme"
    master.write_text(master.read_text() + "Comments :added mass = 5.01 kg\nComments :windy day\n")
    conditions = read_recording(mme).recording.conditions
    assert conditions["added mass"] == pytest.approx(5.01)
    assert conditions["temperature"] == pytest.approx(293.35)
    assert conditions["release angle"] == pytest.approx(0.2618)


def test_latin_letters_of_an_old_file_are_read(mme: Path):
    master = mme / "leg.mme"
    text = master.read_text().replace(
        "Laboratory name              :NOVALUE", "Laboratory name :Prüfstelle Köln"
    )
    master.write_bytes(text.encode("cp1252"))
    assert read_recording(mme).header["Laboratory name"] == "Prüfstelle Köln"


def test_a_failed_channel_is_not_used_and_said_so(mme: Path):
    channel = mme / "Channel/leg.001"
    channel.write_text(channel.read_text().replace(":ok", ":channel failed"))
    read = read_recording(mme).recording
    assert "T1" not in read
    assert [note.code for note in read.notes] == ["status-not-good"]


def test_of_a_filtered_and_an_unfiltered_channel_the_unfiltered_is_used(recording: Recording, tmp_path: Path):
    write_mme(recording, tmp_path / "leg")
    folder = tmp_path / "leg/Channel"
    text = (folder / "leg.001").read_text().replace("PFMOX0", "PFMOXC")
    (folder / "leg.008").write_text(text)
    listed = (folder / "leg.chn").read_text().replace(":7\n", ":8\n")
    (folder / "leg.chn").write_text(listed + "Name of channel 008 :D0TIBIUP00PFMOXC / again\n")
    read = read_recording(tmp_path / "leg").recording
    assert read["T1"].filtered == ""
    assert any(note.code == "recorded-twice" for note in read.notes)


def test_a_laboratory_brings_its_own_codes_and_signs(recording: Recording, tmp_path: Path):
    theirs = Mapping.model_validate(
        {"mapping": "theirs", "mme": {"codes": {"T1": ["H3TIBIXX11PFMOX0"]}, "signs": {"T1": -1}}}
    )
    write_mme(recording, tmp_path / "leg", mapping=theirs)
    assert "H3TIBIXX11PFMOX0" in (tmp_path / "leg/Channel/leg.chn").read_text()
    assert "T1" not in read_recording(tmp_path / "leg").recording
    turned = read_recording(tmp_path / "leg", theirs).recording["T1"].values
    np.testing.assert_allclose(turned, -recording["T1"].values, rtol=1e-8)


def test_a_mapping_names_columns_units_signs_and_decimal_commas(tmp_path: Path):
    path = tmp_path / "lab.csv"
    rows = "\n".join(f"{i * 0.1:.1f};{-i * 2:.1f};{i * 0.01:.2f}".replace(".", ",") for i in range(50))
    path.write_text(f"Prüfung 7;;\nZeit;Tib1;Band\nms;Nm;cm\n{rows}\n", encoding="cp1252")
    mapping = Mapping.model_validate(
        {
            "mapping": "lab",
            "csv": {
                "delimiter": ";",
                "decimal": ",",
                "head": 2,
                "skip": 1,
                "time": {"column": "Zeit", "unit": "ms"},
                "columns": {
                    "T1": {"column": "Tib1", "unit": "N·m", "sign": -1, "filter": "CFC 180"},
                    "MCL": {"column": 3, "unit": "cm"},
                },
            },
            "conditions": {"temperature": "20 degC"},
        }
    )
    read = read_csv(path, mapping).recording
    assert read.interval == pytest.approx(1e-4)
    assert read["T1"].values[10] == pytest.approx(20.0)
    assert read["T1"].filtered == "CFC 180"
    assert read["MCL"].values[10] == pytest.approx(1e-3)
    assert read.conditions["temperature"] == pytest.approx(293.15)


def test_a_mapping_can_give_the_sampling_interval(tmp_path: Path):
    path = tmp_path / "lab.csv"
    path.write_text("1\n2\n3\n")
    layout = {
        "head": 0,
        "time": {"sampling interval": "0.1 ms", "first sample": "-10 ms"},
        "columns": {"T1": {"column": 1, "unit": "N·m"}},
    }
    read = read_csv(path, Mapping.model_validate({"mapping": "lab", "csv": layout})).recording
    np.testing.assert_allclose(read.time, [-0.01, -0.0099, -0.0098])


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_no_bytes_whatever_do_more_than_a_data_error(
    data: st.DataObject, recording: Recording, tmp_path: Path
):
    whole = csv_text(recording).encode()[:4000]
    start = data.draw(st.integers(0, len(whole)))
    spoilt = (
        whole[:start] + data.draw(st.binary(max_size=30)) + whole[start + data.draw(st.integers(0, 30)) :]
    )
    path = tmp_path / "fuzz.csv"
    path.write_bytes(spoilt)
    try:
        read = read_recording(path).recording
    except DataError:
        return
    assert all(np.isfinite(channel.values).all() for channel in read.channels.values())


@pytest.mark.slow
def test_pyisomme_sees_the_same_channels_units_and_values(mme: Path, recording: Recording):
    python = os.environ.get("CERTKIT_PYISOMME_PYTHON")
    if not python:
        pytest.skip(
            "CERTKIT_PYISOMME_PYTHON names no Python with pyisomme (800 MB, an environment of its own)"
        )
    script = Path(__file__).parents[1] / "support" / "pyisomme_check.py"
    done = subprocess.run([python, str(script), str(mme)], capture_output=True, check=True, text=True)
    seen = json.loads(done.stdout)
    assert len(seen) == len(recording.channels)
    for code, name, unit, scale in (
        ("D0TIBIUP00PFMOX0", "T1", "N m", 1.0),
        ("D0KNEEMC00PFDC00", "MCL", "mm", 1e3),
    ):
        assert seen[code]["unit"] == unit
        assert seen[code]["first"] == pytest.approx(recording.time[0])
        np.testing.assert_allclose(seen[code]["values"], recording[name].values * scale, rtol=1e-8, atol=1e-9)


def test_columns_that_are_not_mapped_may_hold_anything(tmp_path: Path):
    path = tmp_path / "lab.csv"
    path.write_text("t,ok,T\n" + "".join(f"{i / 1000},yes,{i}\n" for i in range(30)))
    layout = {"time": {"column": "t", "unit": "s"}, "columns": {"T1": {"column": "T", "unit": "N·m"}}}
    mapping = Mapping.model_validate({"mapping": "lab", "csv": layout})
    assert read_csv(path, mapping).recording["T1"].values[-1] == 29
    path.write_text(path.read_text().replace("0.01,yes", "0.01,yes,yes"))
    with pytest.raises(DataError, match=r"lab\.csv:12: 4 values where 3 values"):
        read_csv(path, mapping)


def test_every_channel_has_a_code_that_means_it_alone():
    table = code_table()
    assert set(table.codes) == set(default_channels().kinds)
    for name in default_channels().kinds:
        for filtered in ("", "CFC 180"):
            assert table.channel(table.code(name, filtered)) == name
