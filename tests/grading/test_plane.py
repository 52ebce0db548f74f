"""Curves against polygons and bands: distances, coverage, and what never passes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.sheets import TIME, bump, corridor_set, grade, only, procedure, recording

from certkit.errors import UsageError
from certkit.grading.corridor_distance import band_distance, end_faces, polygon_distance, refined

SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 100.0], [0.0, 100.0]])
LEVELS = np.linspace(0.0, 4000.0, 41)
KNEE = {
    "id": "MCL-force",
    "channel": None,
    "curve": {"x": "ram force", "y": "MCL"},
    "measure": "curve in polygon",
}


def knee(slope: float, *, upto: float = 4000.0):
    """Return a static knee test whose MCL grows by `slope` mm per kilonewton."""
    force = LEVELS[upto >= LEVELS]
    sheet = procedure({**KNEE, "corridor": "set/area"}, rig={"loading ram": {"force": "4 kN", "levels": 40}})
    return sheet, recording(
        {"ram force": force, "MCL": slope * force * 1e-6}, time=np.arange(float(force.size))
    )


def area(*points: tuple[str, str]):
    return corridor_set(polygons={"area": {"x": "ram force", "y": "MCL elongation", "points": points}})


FAN = area(("0 N", "-1 mm"), ("4 kN", "14 mm"), ("4 kN", "26 mm"), ("0 N", "1 mm"))


def test_distances_inside_a_polygon_are_positive_and_outside_negative():
    x, y = np.array([5.0, 5.0, 5.0, -1.0, 0.0]), np.array([50.0, 90.0, 110.0, 50.0, 50.0])
    np.testing.assert_allclose(polygon_distance(x, y, SQUARE), [50.0, 10.0, -10.0, -10.0, 0.0], atol=1e-9)


@given(st.floats(-20, 30), st.floats(-200, 300))
def test_a_point_is_inside_a_rectangle_when_both_its_coordinates_are(x: float, y: float):
    distance = polygon_distance(np.array([x]), np.array([y]), SQUARE)[0]
    if 1e-6 < x < 10 - 1e-6 and 1e-5 < y < 100 - 1e-5:
        assert distance > 0
    elif x < -1e-6 or x > 10 + 1e-6 or y < -1e-5 or y > 100 + 1e-5:
        assert distance < 0


@given(st.integers(0, 3), st.booleans())
def test_it_does_not_matter_where_a_polygon_begins_or_which_way_it_turns(first: int, back: bool):  # noqa: FBT001  # drawn by hypothesis
    corners = np.roll(SQUARE, first, axis=0)[:: -1 if back else 1]
    x, y = np.array([2.0, 12.0]), np.array([30.0, 30.0])
    np.testing.assert_allclose(polygon_distance(x, y, corners), [20.0, -20.0])


def test_a_notch_between_two_samples_is_found():
    notched = np.array([[0, 0], [10, 0], [10, 10], [5.2, 10], [5.0, 4.0], [4.8, 10], [0, 10]], dtype=float)
    ends = np.array([0.1, 9.9]), np.array([5.0, 5.0])
    assert (polygon_distance(*ends, notched) > 0).all()
    x, y, _ = refined(*ends, most=4000)
    assert polygon_distance(x, y, notched).min() < 0


def test_a_curve_inside_its_polygon_passes():
    found = only(grade(*_with(knee(5.0), FAN)))
    assert found.verdict == "pass"
    assert found.unit == "mm"
    assert found.lower == 0.0
    assert found.margin > 0
    assert found.curve.polygon[1] == (4000.0, 14.0)


def test_the_margin_is_not_taken_to_the_end_that_the_curve_runs_through():
    """At 4 kN the curve stands on the polygon's last side, 6 mm from its limits."""
    assert only(grade(*_with(knee(5.0), FAN))).margin > 0.5


def test_a_curve_that_closes_in_on_a_limit_and_stops_is_near_to_it():
    near = only(grade(*_with(knee(6.4), FAN)))
    assert near.verdict == "pass"
    assert near.margin < 0.5


def test_a_rising_curve_may_leave_through_the_top():
    """Moment over deflection: the corridor ends at its highest moment."""
    corners = np.array([[0, 0], [21, 380], [16, 380], [0, 50]], dtype=float)
    x = np.linspace(0.5, 18.5, 200)
    y = 380 * x / 18.5
    assert polygon_distance(x, y, corners, end_faces(x, y, corners))[-1] > 20


def test_a_curve_that_leaves_its_polygon_fails():
    found = only(grade(*_with(knee(7.0), FAN)))
    assert found.verdict == "fail"
    assert found.margin < 0


def test_a_curve_that_leaves_and_comes_back_fails():
    sheet, rec = knee(5.0)
    rec.channels["MCL"].values[20] = 0.030
    assert only(grade(sheet, FAN, rec)).verdict == "fail"


def test_a_test_that_was_stopped_half_way_is_not_evaluated():
    found = only(grade(*_with(knee(5.0, upto=2000.0), FAN)))
    assert found.verdict == "not evaluated"
    assert "50% of the corridor" in found.reason


def test_a_test_that_was_stopped_half_way_but_left_the_polygon_fails():
    assert only(grade(*_with(knee(9.0, upto=2000.0), FAN))).verdict == "fail"


def test_a_polygon_of_other_channels_is_an_error_of_the_definitions():
    wrong = corridor_set(
        polygons={
            "area": {
                "x": "ram force",
                "y": "ACL",
                "points": [("0 N", "0 mm"), ("1 N", "0 mm"), ("1 N", "1 mm")],
            }
        }
    )
    with pytest.raises(UsageError, match="not the plane of criterion MCL-force"):
        grade(*_with(knee(5.0), wrong))


def test_a_polygon_in_the_wrong_unit_is_an_error_of_the_definitions():
    wrong = area(("0 mm", "0 mm"), ("1 mm", "0 mm"), ("1 mm", "1 mm"))
    with pytest.raises(UsageError, match="corridor set/area: `0 mm` has the unit `mm`"):
        grade(*_with(knee(5.0), wrong))


def test_without_a_polygon_the_curve_is_shown_and_not_graded():
    waiting = corridor_set(awaited={"area": "found in no open text"})
    found = only(grade(*_with(knee(5.0), waiting)))
    assert (found.verdict, found.graded, found.reason) == ("not evaluated", False, "found in no open text")
    assert found.value == pytest.approx(20.0)
    assert len(found.curve.points) == 41


def _with(sheet_and_recording, corridors):  # noqa: ANN001, ANN202  # what the functions above return
    sheet, rec = sheet_and_recording
    return sheet, corridors, rec


BAND = corridor_set(
    bands={
        "T1": {
            "lower": [("0 ms", "-20 N·m"), ("50 ms", "180 N·m"), ("150 ms", "-20 N·m")],
            "upper": [("0 ms", "60 N·m"), ("200 ms", "300 N·m")],
        }
    }
)
IN_BAND = procedure({"id": "T1", "measure": "curve in band", "corridor": "set/T1"})


def hill(peak: float):
    return recording({"T1": np.interp(TIME, [0, 0.05, 0.15, 0.2], [20.0, peak, 20.0, 20.0])})


def test_a_channel_inside_its_corridor_over_time_passes():
    upper = 60 + 240 * 0.05 / 0.2
    found = only(grade(IN_BAND, BAND, hill(upper - 50 + 130)))
    assert found.verdict == "fail"  # 250 N·m at 50 ms is over the upper line
    calm = corridor_set(bands={"T1": {"upper": [("0 ms", "300 N·m"), ("200 ms", "300 N·m")]}})
    found = only(grade(IN_BAND, calm, hill(250.0)))
    assert found.verdict == "pass"
    assert found.margin == pytest.approx(50.0)
    assert found.time == pytest.approx(0.05)
    assert found.band.upper == [(0.0, 300.0), (0.2, 300.0)]


def test_a_corridor_that_outlasts_the_record_is_not_evaluated():
    longer = corridor_set(bands={"T1": {"upper": [("0 ms", "300 N·m"), ("250 ms", "300 N·m")]}})
    found = only(grade(IN_BAND, longer, hill(250.0)))
    assert found.verdict == "not evaluated"
    assert "the corridor reaches from 0 to 250 ms" in found.reason


def test_where_a_corridor_does_not_reach_it_does_not_judge():
    lower = np.array([[0.0, 0.0], [1.0, 0.0]])
    time, values = np.array([-1.0, 0.5, 2.0]), np.array([-9.0, 3.0, -9.0])
    np.testing.assert_array_equal(band_distance(time, values, lower, None), [np.inf, 3.0, np.inf])


def test_a_hill_under_the_lower_line_fails():
    found = only(grade(IN_BAND, BAND, recording({"T1": bump(100.0)})))
    assert found.verdict == "fail"
