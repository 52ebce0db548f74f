"""certkit's own CSV of channels says by itself what it is, and does nothing where it is opened."""

from __future__ import annotations

import csv
import io
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from msgspec.structs import replace
from support import synthetic_result
from support.curves import write_csv

import certkit
from certkit.definitions.loading.channel_tables import default_channels
from certkit.documents.result import Result
from certkit.errors import DataError
from certkit.exchange.channels_csv import channels_csv, csv_text
from certkit.exchange.csv_read import read_csv
from certkit.signals import Channel, Recording

if TYPE_CHECKING:
    from pathlib import Path


def recording() -> Recording:
    time = np.arange(-5, 20) * 1e-4
    kinds = {name: default_channels().kinds[name] for name in ("T1", "MCL")}
    return Recording(
        "simulated",
        time,
        {
            name: Channel(name, kind.title, kind.dimension, np.sin(1e3 * time) * scale, filtered=seen)
            for (name, kind), scale, seen in zip(kinds.items(), (200.0, 0.02), ("CFC 180", ""), strict=True)
        },
        conditions={"temperature": 293.15, "release angle": 0.25},
    )


def test_kind_filters_and_conditions_come_back(tmp_path: Path):
    path = tmp_path / "leg.csv"
    write_csv(recording(), path)
    again = read_csv(path).recording
    assert again.kind == "simulated"
    assert again.conditions == {"temperature": 293.15, "release angle": 0.25}
    assert [channel.filtered for channel in again.channels.values()] == ["CFC 180", ""]
    assert again.notes == ()
    np.testing.assert_allclose(again["T1"].values, recording()["T1"].values, rtol=1e-8, atol=1e-9)


def test_the_table_of_a_result_names_its_procedure_and_id():
    result = synthetic_result.result()
    lines = channels_csv(result).splitlines()
    assert f"# procedure: {result.procedure}" in lines
    assert f"# result: {result.id}" in lines


def test_a_runs_table_grades_like_the_run_wherever_it_lies(tmp_path: Path):
    first = certkit.run("pendulum", refine=False)
    path = tmp_path / "elsewhere" / "leg.csv"
    path.parent.mkdir()
    path.write_text(channels_csv(first), encoding="utf-8")
    again = certkit.grade("pendulum", path)
    assert again.kind == first.kind
    assert again.conditions == pytest.approx(first.conditions)
    assert {c.id: c.verdict for c in again.criteria} == {c.id: c.verdict for c in first.criteria}
    for before, after in zip(first.criteria, again.criteria, strict=True):
        assert after.value == pytest.approx(before.value, rel=1e-5)


def test_a_table_that_does_not_say_its_kind_is_taken_as_measured_and_says_so(tmp_path: Path):
    path = tmp_path / "leg.csv"
    path.write_text(csv_text(recording()).replace("# kind: simulated\n", ""), encoding="utf-8")
    again = read_csv(path).recording
    assert again.kind == "measured"
    assert [note.code for note in again.notes] == ["kind-not-said"]


def test_a_kind_that_is_none_is_refused_with_its_line(tmp_path: Path):
    path = tmp_path / "leg.csv"
    path.write_text(csv_text(recording()).replace("simulated", "dreamt"), encoding="utf-8")
    with pytest.raises(DataError, match=r"leg\.csv:1: no kind of test is `dreamt`"):
        read_csv(path)


def test_a_missing_value_is_an_empty_cell():
    values = recording()["MCL"].values.copy()
    values[3] = np.nan
    gone = replace(recording(), channels={"MCL": replace(recording()["MCL"], values=values)})
    assert csv_text(gone).splitlines()[-22].endswith(",")


@given(st.text(max_size=40), st.text(max_size=40))
@example(";@", "")
def test_no_cell_of_the_head_begins_a_formula(name: str, procedure: str):
    channel = replace(recording()["T1"], name=name)
    text = csv_text(replace(recording(), channels={name: channel}), procedure=procedure, result_id=procedure)
    head = text[: text.index("\n-0.0005,")]
    for delimiter in ",;\t":
        for row in csv.reader(io.StringIO(head), delimiter=delimiter):
            remark = row[0].startswith("#")
            assert not (remark and len(row) > 1)
            assert not any(cell.startswith(("=", "+", "-", "@")) for cell in row)


def test_a_result_whose_names_are_formulas_is_written_harmless():
    document = synthetic_result.document()
    document["channels"]["series"]["=HYPERLINK(1)"] = document["channels"]["series"].pop("T1")
    text = channels_csv(Result.model_validate(document))
    heads = next(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
    assert "'=HYPERLINK(1) [N·m]" in heads
