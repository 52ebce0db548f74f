"""The quality gate, and the numerical uncertainty from refined runs."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec import Struct
from msgspec.structs import replace

from certkit.grading import StepChange, grade_quality, largest_step_change, numerical_uncertainties
from certkit.grading.front_limits import FrontUse, Use


class Figures(Struct, frozen=True):
    energy_error_percent: float = 0.05
    joint_gap_mm: float = 0.006
    penetration_mm: float = 0.3
    flesh_depth_percent: float = 94.0
    steps: int = 30000
    time_step: float = 2e-5


def test_a_group_that_flies_into_the_car_is_an_error():
    assert grade_quality(Figures(), front=FrontUse(205.0, None, None)).verdict == "pass"
    flown = grade_quality(Figures(), front=FrontUse(893.0, None, None))
    assert flown.verdict == "error"
    assert [check.value for check in flown.checks if check.verdict == "error"] == [893.0]


@pytest.mark.parametrize("use", [{"room": Use("E3", 100.4)}, {"springs": Use("F1 to E1", 100.4)}])
def test_a_group_without_room_and_a_spring_without_curve_are_errors_alone(use: dict[str, Use]):
    within = FrontUse(90.0, Use("E3", 99.0), Use("F1 to E1", 99.0))
    assert grade_quality(Figures(), front=within).verdict == "pass"
    beyond = grade_quality(Figures(), front=replace(within, **use))
    assert beyond.verdict == "error"
    (check,) = [check for check in beyond.checks if check.verdict == "error"]
    assert check.remedy is not None
    assert next(iter(use.values())).name in check.remedy.parameters.values()


def test_a_run_within_all_limits_can_be_trusted():
    quality = grade_quality(Figures(), step_change=StepChange(0.04, "T1"), solver_seconds=0.2)
    assert quality.verdict == "pass"
    assert [check.verdict for check in quality.checks] == ["pass"] * 5


@pytest.mark.parametrize(
    "worse",
    [
        {"energy_error_percent": 0.51},
        {"joint_gap_mm": 0.021},
        {"penetration_mm": 2.1},
        {"flesh_depth_percent": 100.1},
        {"energy_error_percent": math.nan},
        {"joint_gap_mm": math.inf},
    ],
)
def test_one_figure_beyond_its_limit_is_an_error(worse: dict[str, float]):
    assert grade_quality(replace(Figures(), **worse)).verdict == "error"


@pytest.mark.parametrize("change", [0.51, math.inf, math.nan])
def test_a_step_that_matters_is_an_error(change: float):
    assert grade_quality(Figures(), step_change=StepChange(change, "T1")).verdict == "error"


def test_nobody_looking_at_the_step_is_told_apart_from_no_change():
    assert grade_quality(Figures()).step_change_percent is None
    assert grade_quality(Figures(), step_change=StepChange(0.0, "")).step_change_percent == 0.0


@given(st.floats(100, 300), st.floats(-5, 5))
def test_second_order_is_assumed_of_two_runs_and_its_error_trebled(exact: float, error: float):
    at = {h: {"T1": exact + error * h**2} for h in (1.0, 0.5)}
    found = numerical_uncertainties(at[1.0], at[0.5])
    assert found == {"T1": pytest.approx(3.0 * abs(error), abs=1e-9)}


def test_only_criteria_that_both_runs_measured_get_an_uncertainty():
    reported = {"T1": 250.0, "T2": None, "T3": 1.0, "T4": 1.0}
    assert numerical_uncertainties(reported, {"T1": 251.0, "T2": 3.0, "T4": math.inf}) == {
        "T1": pytest.approx(4.0)
    }


def test_where_no_flesh_is_compressed_nothing_is_said_of_it():
    codes = [c.coded_title.code for c in grade_quality(replace(Figures(), flesh_depth_percent=0.0)).checks]
    assert "flesh-depth" not in codes


def test_a_step_that_matters_names_the_channel_and_the_remedy():
    (check,) = [
        check
        for check in grade_quality(Figures(), step_change=StepChange(0.8, "PCL")).checks
        if check.verdict != "pass"
    ]
    assert check.remedy is not None
    assert check.remedy.parameters == {"criterion": "PCL", "step": 1e-5}


def test_the_step_change_is_the_largest_of_all_criteria_and_names_it():
    change = largest_step_change({"T1": 200.0, "T2": 100.0}, {"T1": 201.0, "T2": 100.2})
    assert (change.percent, change.criterion) == (pytest.approx(0.5), "T1")


def test_a_peak_of_nearly_zero_is_measured_by_its_floor():
    assert largest_step_change({"F3": 0.001}, {"F3": 0.002}, {"F3": 1.0}).percent == pytest.approx(0.1)


def test_a_criterion_that_appears_or_vanishes_is_an_endless_change():
    assert largest_step_change({"T1": None}, {"T1": 1.0}) == StepChange(math.inf, "T1")
    assert largest_step_change({"T1": None}, {"T1": None}) == StepChange(0.0, "")
