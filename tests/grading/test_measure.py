"""Measures: each returns the value and when it occurred, or says why it cannot."""

from __future__ import annotations

import numpy as np
import pytest
from support.sheets import TIME, bump, criterion, recording

from certkit.definitions.channels import TIME as TIME_DIMENSION
from certkit.errors import UsageError
from certkit.grading.measure import NoInterval, measure
from certkit.grading.measured_value import MeasuredValue
from certkit.grading.trace import EvaluationWindow
from certkit.reasons import Reason
from certkit.signals import AssessmentInterval, Filtered, Recording

WHOLE = EvaluationWindow(0.0, 0.2)
NO_INTERVAL = NoInterval(Reason.words("made up"))


def taken(
    rec: Recording,
    window: EvaluationWindow = WHOLE,
    interval: AssessmentInterval | NoInterval = NO_INTERVAL,
    **fields: object,
) -> MeasuredValue:
    return measure(criterion(**{"channel": "T1", **fields}), Filtered(rec), window, interval)


DIP_AND_HILL = recording({"T1": bump(250.0) - bump(300.0, at=0.12)})


def test_max_is_the_highest_value_and_its_time():
    found = taken(DIP_AND_HILL)
    assert found.value == pytest.approx(250.0)
    assert found.time == pytest.approx(0.05)


def test_min_is_the_lowest_value():
    found = taken(DIP_AND_HILL, measure="min")
    assert (found.value, found.time) == (pytest.approx(-300.0), pytest.approx(0.12))


def test_max_abs_is_the_size_of_the_larger_side():
    found = taken(DIP_AND_HILL, measure="max abs")
    assert (found.value, found.time) == (pytest.approx(300.0), pytest.approx(0.12))


def test_time_of_max_is_a_time():
    found = taken(DIP_AND_HILL, measure="time of max")
    assert found.value == pytest.approx(0.05)
    assert found.dimension is TIME_DIMENSION


def test_channels_are_found_by_the_words_of_the_field():
    assert taken(DIP_AND_HILL, channel="tibia moment 1").value == pytest.approx(250.0)


def test_a_filter_lowers_a_sharp_peak():
    sharp = recording({"T1": np.where(np.abs(TIME - 0.1) < 2e-4, 100.0, 0.0)})
    raw, filtered = taken(sharp).value, taken(sharp, filter="CFC 180").value
    assert raw == 100.0
    assert 5.0 < filtered < 80.0


def test_only_the_window_counts():
    found = taken(DIP_AND_HILL, window=EvaluationWindow(0.0, 0.04))
    assert found.value == pytest.approx(125.0)
    assert found.time == pytest.approx(0.04)


def test_only_the_assessment_interval_counts_where_the_criterion_says_so():
    interval = AssessmentInterval(0.0, 0.08, "T1", 0.0, ())
    assert taken(DIP_AND_HILL, interval=interval, measure="max abs").value == pytest.approx(300.0)
    within = measure(
        criterion(channel="T1", measure="max abs", interval="assessment interval"),
        Filtered(DIP_AND_HILL),
        WHOLE,
        interval,
    )
    assert within.value == pytest.approx(250.0)


def test_without_an_assessment_interval_nothing_is_measured():
    found = measure(
        criterion(channel="T1", interval="assessment interval"), Filtered(DIP_AND_HILL), WHOLE, NO_INTERVAL
    )
    assert found.value is None
    assert found.reason == NO_INTERVAL.reason


LEVELS = np.linspace(0.0, 5000.0, 11)
STAIRCASE = recording({"ram force": LEVELS, "mid moment": 0.08 * LEVELS}, time=np.arange(11.0))


def at_force(words: str) -> MeasuredValue:
    window = EvaluationWindow(0.0, 10.0)
    return taken(
        STAIRCASE,
        window=window,
        channel="mid moment",
        measure="value at",
        at={"channel": "ram force", "equals": words},
    )


def test_value_at_interpolates_between_two_samples():
    found = at_force("4848 N")
    assert found.value == pytest.approx(0.08 * 4848)
    assert found.time == pytest.approx(4848 / 500)


def test_value_at_hits_a_sample_exactly():
    assert at_force("4.5 kN").value == pytest.approx(360.0)
    assert at_force("0 N").value == 0.0


def test_a_last_level_missed_by_rounding_counts_as_reached():
    rec = recording(
        {"ram force": [0.0, 4848.0 * (1 - 1e-12)], "mid moment": [0.0, 400.0]}, time=np.array([0.0, 1.0])
    )
    found = taken(
        rec,
        channel="mid moment",
        measure="value at",
        at={"channel": "ram force", "equals": "4848 N"},
        window=EvaluationWindow(0, 1),
    )
    assert found.value == pytest.approx(400.0)


def test_value_at_a_level_that_is_never_reached_is_not_measured():
    found = at_force("5001 N")
    assert found.value is None
    assert found.reason == Reason.of("level-never-reached", channel="ram force", level="5001 N")


def test_value_at_takes_the_first_time_of_several():
    rec = recording({"contact force": bump(100.0) + bump(100.0, at=0.15), "T1": TIME})
    found = taken(rec, measure="value at", at={"channel": "contact force", "equals": "50 N"})
    assert found.time == pytest.approx(0.04, abs=1e-4)


def test_value_at_of_a_missing_guide_is_not_measured():
    found = taken(DIP_AND_HILL, measure="value at", at={"channel": "ram force", "equals": "1 N"})
    assert found.value is None
    assert found.reason == Reason.of("channel-not-recorded", channel="ram force")


def test_a_wrong_unit_is_an_error_of_the_sheet():
    with pytest.raises(UsageError, match="criterion T1, `at`: `4848 mm` has the unit `mm`"):
        at_force("4848 mm")


def test_value_at_without_a_place_is_an_error_of_the_sheet():
    with pytest.raises(UsageError, match="needs `at"):
        taken(DIP_AND_HILL, measure="value at")


def test_a_missing_channel_is_not_measured():
    found = taken(recording({"T2": bump(1.0)}))
    assert found.value is None
    assert found.reason == Reason.of("channel-not-recorded", channel="T1")
    assert found.dimension.unit == "N·m"


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("how", ["max", "min", "max abs", "time of max"])
def test_a_channel_with_one_bad_value_is_not_measured(bad: float, how: str):
    values = bump(250.0)
    values[1234] = bad
    found = taken(recording({"T1": values}), measure=how)
    assert found.value is None
    assert found.reason == Reason.of("channel-not-finite", channel="T1", bad=1, count=2001)


def test_a_record_that_ends_before_contact_is_not_measured():
    time = TIME - 1.0
    found = taken(recording({"T1": bump(1.0)}, time=time))
    assert found.reason == Reason.of("nothing-recorded", start=0.0, end=200.0)
