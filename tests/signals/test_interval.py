"""The assessment interval of a vehicle test."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.reasons import Reason
from certkit.signals import AssessmentInterval, assessment_interval

if TYPE_CHECKING:
    from support.curves import Floats

TIME = np.arange(0, 0.1, 1e-5)


def bending(zero: float, peak: float = 200.0, back: float = -60.0) -> Floats:
    """Return a moment that peaks, crosses zero at `zero` (s) and bends back."""
    first = peak * np.sin(np.pi * TIME / zero)
    return np.where(zero >= TIME, first, back * np.sin(np.pi * (TIME - zero) / (0.1 - zero)))


def test_it_ends_with_the_last_zero_crossing_of_all_bones():
    found = assessment_interval(TIME, {"T1": bending(0.030), "T2": bending(0.034), "F1": bending(0.041)})
    assert isinstance(found, AssessmentInterval)
    assert found.decided_by == "F1"
    assert found.start == 0
    assert found.end == pytest.approx(0.041, abs=1e-6)
    assert found.shift == 0


def test_only_the_first_crossing_of_each_bone_counts():
    ringing = 100.0 * np.sin(2 * np.pi * TIME / 0.05)  # crosses at 25, 50, 75 ms
    found = assessment_interval(TIME, {"T1": ringing, "T2": bending(0.030)})
    assert isinstance(found, AssessmentInterval)
    assert found.end == pytest.approx(0.030, abs=1e-6)


def test_a_maximum_within_15_newton_metres_does_not_count():
    ripple = np.where(TIME < 0.01, 14.0 * np.sin(np.pi * TIME / 0.01), 0.0)
    late = np.where(TIME >= 0.01, 120.0 * np.sin(np.pi * (TIME - 0.01) / 0.03), 0.0)
    found = assessment_interval(TIME, {"T1": ripple + late})
    assert isinstance(found, AssessmentInterval)
    assert found.end == pytest.approx(0.040, abs=1e-5)


def test_a_bone_that_stays_within_15_newton_metres_takes_no_part():
    found = assessment_interval(TIME, {"T1": bending(0.030), "F3": bending(0.08, peak=14.0)})
    assert isinstance(found, AssessmentInterval)
    assert found.end == pytest.approx(0.030, abs=1e-6)
    assert found.left_out == ("F3",)
    assert "F3" in str(found.reason)


def test_a_bone_that_never_crosses_zero_lowers_all_curves_until_it_does():
    never = 40.0 + 100.0 * np.exp(-(((TIME - 0.02) / 0.01) ** 2)) + 20.0 * ((TIME - 0.06) / 0.04) ** 2
    found = assessment_interval(TIME, {"T1": bending(0.030), "T2": never})
    assert isinstance(found, AssessmentInterval)
    lowest = np.argmin(never[TIME > 0.02]) + np.count_nonzero(TIME <= 0.02)
    assert found.shift == pytest.approx(never[lowest])
    assert found.decided_by == "T2"
    assert found.end == pytest.approx(TIME[lowest], abs=1e-4)
    assert "interval-lowered" in str(found.reason)


def test_a_bone_lowered_below_zero_as_a_whole_has_crossed_at_its_maximum():
    never = 40.0 + bending(0.060, back=-10.0)
    found = assessment_interval(TIME, {"F3": bending(0.090, peak=20.0), "T2": never})
    assert isinstance(found, AssessmentInterval)
    assert found.decided_by == "T2"
    assert np.isfinite(found.end)


def test_the_curves_themselves_are_not_lowered():
    never = 40.0 + bending(0.030, back=-10.0)
    before = never.copy()
    assessment_interval(TIME, {"T2": never})
    np.testing.assert_array_equal(never, before)


def test_no_bending_is_no_interval():
    small = Reason.of("bone-moments-small", marginal=15.0)
    assert assessment_interval(TIME, {"T1": np.zeros_like(TIME)}) == small
    assert assessment_interval(TIME, {}) == small


@pytest.mark.parametrize("end", [0.008, 0.012, 0.0148])
def test_a_bone_still_rising_at_the_records_end_is_not_within_15_newton_metres(end: float):
    inside = end >= TIME
    moments = {"T1": bending(0.010)[inside], "F1": bending(0.030)[inside]}
    found = assessment_interval(TIME[inside], moments)
    assert isinstance(found, Reason)
    assert found.code in {"bone-still-rising", "bone-not-back-to-zero"}


def test_a_record_that_ends_before_a_bone_is_back_at_zero_has_no_interval():
    inside = TIME <= 0.028
    found = assessment_interval(TIME[inside], {"T1": bending(0.020)[inside], "T2": bending(0.030)[inside]})
    assert isinstance(found, Reason)
    assert found.code == "bone-not-back-to-zero"
    assert found.parameters["channel"] == "T2"


def test_the_curves_are_not_lowered_to_a_dip_on_the_way_up():
    way_up = TIME[:5000]
    dip = 150.0 * np.sin(np.pi * way_up / 0.1) - 40.0 * np.exp(-(((way_up - 0.03) / 0.002) ** 2))
    found = assessment_interval(way_up, {"T1": dip, "T2": bending(0.02)[:5000]})
    assert isinstance(found, Reason)
    assert found.code == "bone-not-back-to-zero"


def test_the_curves_are_lowered_to_half_of_a_maximum_at_most():
    shallow = 160.0 + 40.0 * np.cos(2 * np.pi * TIME / 0.04 - np.pi / 2)
    found = assessment_interval(TIME, {"T1": shallow, "T2": bending(0.02)})
    assert isinstance(found, Reason)
    assert found.code == "bones-lowered-too-far"


@pytest.mark.parametrize(("rise", "found"), [(4.5, Reason), (5.5, AssessmentInterval)])
def test_a_low_is_one_when_the_bone_rises_by_5_newton_metres_behind_it(rise: float, found: type):
    places = [0.0, 0.01, 0.03, 0.05, 0.1]
    never = np.interp(TIME, places, [0.0, 100.0, 20.0, 20.0 + rise, 20.0 + rise])
    assert isinstance(assessment_interval(TIME, {"T1": bending(0.02), "T2": never}), found)


def test_bending_before_contact_does_not_count():
    time = TIME - 0.05
    early = np.where(time < -0.01, 100.0 * np.sin(np.pi * (time + 0.05) / 0.04), 0.0)
    late = np.where(time > 0, 100.0 * np.sin(np.pi * time / 0.02), 0.0)
    found = assessment_interval(time, {"T1": early + late})
    assert isinstance(found, AssessmentInterval)
    assert found.end == pytest.approx(0.020, abs=1e-5)
