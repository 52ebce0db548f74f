"""`certkit study` and `certkit calibrate`, as a user calls them."""

from __future__ import annotations

import csv
import json
from typing import TYPE_CHECKING

import pytest
from typer.testing import CliRunner

from certkit.cli.commands import whole_app
from certkit.errors import DefinitionError, UsageError

if TYPE_CHECKING:
    from pathlib import Path

STUDY = """
study: small
title: A small study
procedures: [inverse, pendulum]
parameters:
  - {path: rig.ram.speed, procedure: inverse, uniform: [11.0 m/s, 11.2 m/s]}
  - {path: legform.parts.femur.bending stiffness, uniform: 2 %}
design: {kind: latin hypercube, runs: 4, seed: 1}
"""


def called(*words: object) -> str:
    result = CliRunner().invoke(whole_app(), [str(word) for word in words], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.stdout


@pytest.fixture
def sheet(tmp_path: Path) -> Path:
    path = tmp_path / "small.yaml"
    path.write_text(STUDY, "utf-8")
    return path


def test_a_study_writes_its_table_its_findings_and_its_page(sheet: Path, tmp_path: Path) -> None:
    printed = called(
        "study", sheet, "--out", tmp_path / "out", "--processes", 1, "--table", "csv,json,parquet"
    )
    assert "pendulum/T1" in printed
    with (tmp_path / "out/table.csv").open(newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == 4
    assert {"inverse/rig.ram.speed [m/s]", "inverse/T1 margin [N·m]", "pendulum/MCL [mm]"} <= set(rows[0])
    table = json.loads((tmp_path / "out/table.json").read_text("utf-8"))
    # The same numbers to the last bit, and the inverse test alone feels its ram.
    for row, written in zip(table["rows"], rows, strict=True):
        assert row["pendulum/T1"] == float(written["pendulum/T1 [N·m]"])
        assert row["pendulum/verdict"] == "pass"
    findings = json.loads((tmp_path / "out/study.json").read_text("utf-8"))
    assert findings["failed"] == 0
    assert (tmp_path / "out/study.html").read_text("utf-8").startswith("<!DOCTYPE html>")
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pyarrow")
    stored = pandas.read_parquet(tmp_path / "out/table.parquet")
    assert stored["inverse/T1"].tolist() == [row["inverse/T1"] for row in table["rows"]]


def test_a_study_called_again_does_nothing_twice_and_writes_the_same(sheet: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    called("study", sheet, "--out", out, "--processes", 1, "--quiet")
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    printed = called("study", sheet, "--out", out, "--processes", 1, "--json")
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    assert json.loads(printed) == json.loads(before["study.json"])


def test_a_run_that_fails_is_a_row_with_its_error(tmp_path: Path) -> None:
    path = tmp_path / "failing.yaml"
    path.write_text(
        "study: failing\ntitle: Some runs fail\nprocedures: [inverse]\n"
        "parameters:\n  - {path: run.time step, values: [20 µs, 1000 µs]}\n"
        "design: {kind: full factorial}\n",
        "utf-8",
    )
    called("study", path, "--out", tmp_path / "out", "--processes", 1)
    rows = json.loads((tmp_path / "out/table.json").read_text("utf-8"))["rows"]
    assert rows[0]["error"] == ""
    assert "ran away" in rows[1]["error"]
    assert rows[1]["inverse/T1"] is None


@pytest.mark.parametrize(
    ("old", "new", "error", "message"),
    [
        ("rig.ram.speed", "rig.ram.sped", UsageError, "rig.ram.speed"),
        ("11.2 m/s", "11.2 km/h", UsageError, "in m/s"),
        ("procedure: inverse,", "procedure: invers,", DefinitionError, "no procedure of this study"),
        ("latin hypercube, runs: 4", "latin hypercube", DefinitionError, "runs"),
        ("uniform: 2 %", "uniform: 2 %, values: [1, 2]", DefinitionError, "in one way"),
    ],
)
def test_a_study_that_makes_no_sense_is_refused_before_anything_is_run(
    sheet: Path, tmp_path: Path, old: str, new: str, error: type[Exception], message: str
) -> None:
    sheet.write_text(STUDY.replace(old, new), "utf-8")
    with pytest.raises(error, match=message):
        called("study", sheet, "--out", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_table_format_that_cannot_be_written_is_refused_before_anything_is_run(
    sheet: Path, tmp_path: Path
) -> None:
    with pytest.raises(UsageError, match="no format of a table"):
        called("study", sheet, "--out", tmp_path / "out", "--table", "xlsx")
    assert not (tmp_path / "out").exists()


def test_ctrl_c_says_that_the_same_command_goes_on(
    sheet: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("certkit.studies.run_study.study", interrupted)
    result = CliRunner().invoke(whole_app(), ["study", str(sheet), "--out", str(tmp_path / "out")])
    assert result.exit_code == 130
    assert "the same command goes on" in result.stderr


def test_a_calibration_writes_a_legform_that_can_be_run(tmp_path: Path) -> None:
    path = tmp_path / "fit.yaml"
    path.write_text(
        "fit: one-number\ntitle: One number\nlegform: flex-pli-gtr\n"
        "parameters:\n  - path: legform.knee.condyles.friction\n"
        "    lower: 0.05\n    upper: 0.4\n    reason: a test\n"
        "targets: [{procedure: inverse, criteria: [MCL]}]\n"
        "search: {generations: 0, steps: 3}\n"
    )
    printed = called("calibrate", path, "--out", tmp_path / "out", "--processes", 1)
    assert "inverse/MCL" in printed
    report = json.loads((tmp_path / "out/fit.json").read_text("utf-8"))
    assert report["rms_after"] <= report["rms_before"]
    shown = called("show", tmp_path / "out/flex-pli-gtr.yaml")
    assert "fit one-number to inverse" in shown
    assert "one-number" in (tmp_path / "out/fit.html").read_text("utf-8")
