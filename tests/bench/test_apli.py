"""The aPLI: its codes are read, its records graded and scored, and its simulation is named a guess."""

from __future__ import annotations

from pathlib import Path

import pytest

import certkit
from certkit.bench.sources import load_source


@pytest.fixture(scope="module")
def result() -> certkit.Result:
    return certkit.run("vehicle-apli", overrides={"vehicle": "generic-sports-car"}, refine=False)


def test_a_simulated_one_says_that_it_is_for_what_if_only(result: certkit.Result):
    assert "model-for-what-if" in [reason.code for reason in result.coded_remarks]
    assert "what-if" in result.specimen["legform"]


def test_it_is_scored_by_euro_ncap_2026(result: certkit.Result):
    assert {s.id: (s.points, s.colour, s.car_points) for s in result.scores} == {
        "femur": (1.0, "green", 2.5),
        "knee and tibia": (1.0, "green", 5.0),
    }
    assert all(criterion.graded for criterion in result.criteria if criterion.id[0] in "FT")


def test_its_record_is_known_by_the_codes_pm_and_graded_alike(result: certkit.Result, tmp_path: Path):
    archive = tmp_path / "test.zip"
    certkit.export(result, archive)
    assert load_source(archive).recording.table.impactor == "aPLI"
    again = certkit.grade("vehicle-apli", archive)
    assert again.verdict == result.verdict
    for criterion in result.criteria:
        assert again.criteria[criterion.id].value == pytest.approx(criterion.value, rel=1e-6)
    assert [s.points for s in again.scores] == [s.points for s in result.scores]


def test_a_flex_pli_is_not_graded_by_its_limits():
    changed = certkit.run(
        "vehicle", overrides={"criteria.T1.corridor": "euro-ncap-2026/tibia moment"}, refine=False
    )
    assert changed.criteria["T1"].verdict == "not evaluated"
