"""A campaign takes a result over that comes to its values when graded again, or says that it cannot be."""

from __future__ import annotations

from pathlib import Path

import pytest

import certkit
from certkit.documents.result import Result
from certkit.documents.unverified import MARK
from certkit.errors import DataError

EXAMPLES = Path(__file__).parents[2] / "examples" / "campaign"
CAR = """\
campaign: car
title: A car
car: {name: Car}
schemes: [r127]
points: [{point: b, across: 0 mm, sources: [{measured: test.json}]}]
"""


@pytest.fixture(scope="module")
def graded() -> Result:
    return certkit.grade("vehicle", EXAMPLES / "L+4.zip", laboratory=EXAMPLES / "lab.yaml").as_written()


def campaign_of(result: Result, folder: Path) -> Path:
    """Write a campaign that rests on one result."""
    (folder / "test.json").write_text(result.to_json(), encoding="utf-8")
    (folder / "car.yaml").write_text(CAR, encoding="utf-8")
    return folder / "car.yaml"


def forged(result: Result) -> Result:
    """Return a result with a ligament that passes, and the id that goes with it."""
    criteria = [c.model_copy(update={"value": 15.0}) if c.id == "MCL" else c for c in result.criteria]
    return result.model_copy(update={"criteria": criteria}).with_id()


def test_a_genuine_test_counts_with_its_values_and_without_a_remark(graded: Result, tmp_path: Path):
    document = certkit.campaign(campaign_of(graded, tmp_path), tmp_path / "out")
    (source,) = document.points[0].sources
    assert {v.id: v.value for v in source.values}["MCL"] == graded.criteria["MCL"].value
    assert document.verdict == "fail"
    assert document.remarks == []
    assert not certkit.verify(tmp_path / "out").of("does not hold")


def test_a_made_up_value_does_not_reach_a_cars_score(graded: Result, tmp_path: Path):
    """Its id is made anew; only grading again shows it."""
    car = campaign_of(forged(graded), tmp_path)
    with pytest.raises(DataError, match=r"point b: .*test\.json: comes to other values when it is graded"):
        certkit.campaign(car)
    document = certkit.campaign(car, unverified=True)
    assert document.points[0].sources[0].certificate == MARK
    assert any(MARK in remark and "b" in remark for remark in document.remarks)


def test_a_result_without_channels_is_told_as_one_that_nothing_follows_from(graded: Result, tmp_path: Path):
    bare = graded.model_copy(update={"channels": None}).with_id()
    document = certkit.campaign(campaign_of(bare, tmp_path))
    assert document.verdict == "fail"
    assert document.remarks == [
        "results without channels could not be graded again; their values are as written: b (test.json)"
    ]
