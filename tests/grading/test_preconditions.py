"""Preconditions: one row each, in the unit they were written in."""

from __future__ import annotations

import pytest
from msgspec.structs import replace
from support.sheets import bump, corridor_set, grade, procedure, recording

WINDOW = corridor_set(windows={"T1": {"upper": "272 N·m"}})
CLIMATE = {"quantity": "temperature", "dimension": "temperature", "within": ["18 °C", "22 °C"]}


def rows(*preconditions: dict, kind: str = "measured", **conditions: float):
    sheet = procedure({"id": "T1", "corridor": "set/T1"}, preconditions=list(preconditions))
    told = {words.replace("_", " "): value for words, value in conditions.items()}
    return grade(sheet, WINDOW, replace(recording({"T1": bump(250.0)}), kind=kind, conditions=told))


@pytest.mark.parametrize(
    ("kelvin", "verdict"),
    [
        (293.15, "pass"),
        (291.15, "pass"),
        (295.15, "pass"),
        (295.2, "not evaluated"),
        (290.0, "not evaluated"),
    ],
)
def test_a_test_outside_its_temperature_is_not_evaluated(kelvin: float, verdict: str):
    result = rows(CLIMATE, temperature=kelvin)
    (row,) = result.preconditions
    assert result.verdict == verdict
    assert row.verdict == ("pass" if verdict == "pass" else "fail")
    assert (row.unit, row.lower, row.upper) == ("°C", pytest.approx(18.0), pytest.approx(22.0))
    assert row.value == pytest.approx(kelvin - 273.15)


def test_the_reason_names_value_and_range():
    result = rows(CLIMATE, temperature=300.15)
    assert result.preconditions[0].reason == "temperature 27 °C is outside 18 °C to 22 °C"


def test_a_condition_that_was_not_recorded_is_not_evaluated():
    result = rows(CLIMATE)
    assert result.verdict == "not evaluated"
    assert result.preconditions[0].reason == "temperature was not recorded"


def test_a_condition_that_is_not_required_may_be_missing_but_not_wrong():
    optional = {**CLIMATE, "required": False}
    assert rows(optional).verdict == "pass"
    assert rows(optional, temperature=310.0).verdict == "not evaluated"


def test_a_condition_that_is_no_number_is_not_evaluated():
    assert rows(CLIMATE, temperature=float("nan")).verdict == "not evaluated"


def test_simulated_tests_have_no_laboratory_climate():
    result = rows(CLIMATE, kind="simulated")
    assert result.preconditions == []
    assert result.verdict == "pass"


def test_speeds_in_kilometres_an_hour_meet_their_own_limits():
    speed = {"quantity": "speed", "dimension": "speed", "within": ["39.28 km/h", "40.72 km/h"]}
    result = rows(speed, speed=40.72 / 3.6)
    assert result.verdict == "pass"
    assert result.preconditions[0].unit == "km/h"


def test_ratios_are_shown_in_percent():
    humid = {"quantity": "humidity", "dimension": "ratio", "within": ["10 %", "70 %"]}
    (row,) = rows(humid, humidity=0.4).preconditions
    assert (row.value, row.unit) == (pytest.approx(40.0), "%")


def test_limits_below_zero_are_read():
    pitch = {"quantity": "pitch", "dimension": "angle", "within": ["-2 deg", "2 deg"]}
    (row,) = rows(pitch, pitch=-0.01).preconditions
    assert (row.verdict, row.lower, row.unit) == ("pass", pytest.approx(-2.0), "deg")
