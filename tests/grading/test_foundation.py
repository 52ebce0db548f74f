"""What stands first beside a pass: its peaks, its limits, and the model or the conditions it rests on."""

from __future__ import annotations

from pathlib import Path

import pytest

import certkit
from certkit.reporting.margins import worst

MEASURED = Path(__file__).parents[2] / "examples/measured/FLX-0007-pendulum.zip"
PROCEDURES = Path(__file__).parents[2] / "procedures"
LINES = 3


def test_a_measured_pass_says_its_peaks_its_limits_and_its_conditions():
    result = certkit.grade("pendulum", MEASURED)
    assert result.verdict == "pass"
    assert [remark.code for remark in result.coded_remarks[:LINES]] == [
        "pass-rests-on-peaks",
        "pass-rests-on-limits",
        "pass-rests-on-conditions",
    ]
    assert "7 peaks inside the record" in result.remarks[0]
    assert "r127-pendulum" in result.remarks[1]
    assert "temperature" in result.remarks[2]


@pytest.mark.parametrize("procedure", ["pendulum", "inverse"])
def test_the_criterion_that_is_called_nearest_is_the_one_that_pages_call_so(procedure: str):
    result = certkit.run(procedure, refine=False)
    assert result.verdict == "pass"
    assert result.coded_remarks[0].parameters["criterion"] == worst(result).id


def test_a_simulated_pass_says_that_its_model_was_fitted_to_these_very_corridors():
    result = certkit.run("pendulum", refine=False)
    assert result.verdict == "pass"
    assert result.coded_remarks[2].code == "pass-rests-on-fitted-model"
    assert "these very corridors" in result.remarks[2]


def test_a_copy_of_the_procedure_under_another_name_says_so_too(tmp_path: Path):
    folder = tmp_path / "procedures"
    folder.mkdir()
    text = (PROCEDURES / "pendulum.yaml").read_text(encoding="utf-8")
    copy = text.replace("procedure: pendulum", "procedure: my-pendulum", 1)
    assert copy != text
    (folder / "my-pendulum.yaml").write_text(copy, encoding="utf-8")
    result = certkit.run("my-pendulum", library=tmp_path, refine=False)
    assert result.verdict == "pass"
    assert result.coded_remarks[2].code == "pass-rests-on-fitted-model"


def test_a_vehicle_test_says_that_no_fit_aimed_at_its_limits():
    result = certkit.run("vehicle", overrides={"vehicle": "generic-suv"}, refine=False)
    assert result.verdict == "pass"
    assert result.coded_remarks[2].code == "pass-rests-on-model"


def test_what_does_not_pass_has_no_such_lines():
    result = certkit.run("static-femur", refine=False)
    assert not [remark for remark in result.coded_remarks if remark.code.startswith("pass-rests")]


def test_a_fitted_value_on_its_bound_is_told():
    change = {"legform.flesh.damping ratio": "0.95"}
    result = certkit.run("pendulum", overrides=change, refine=False)
    assert any("stand on a bound" in remark and "damping ratio" in remark for remark in result.remarks)
