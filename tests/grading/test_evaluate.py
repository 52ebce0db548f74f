"""From a recording to a verdict: missing never passes, NaN never passes, outside never passes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace
from support.sheets import TIME, bump, corridor_set, grade, only, procedure, recording

from certkit.definitions.loading.library import load
from certkit.documents.result import PreconditionResult, Quality
from certkit.errors import DataError, UsageError
from certkit.grading import DecisionRule, criterion_values, measure_all
from certkit.grading.remarks import left_ungraded

WINDOW = corridor_set(windows={"T1": {"lower": "235 N·m", "upper": "272 N·m"}})
SHEET = procedure({"id": "T1", "corridor": "set/T1"})
PENDULUM = load("procedure", "pendulum").document
PENDULUM_CORRIDORS = {"r127-pendulum": load("corridors", "r127-pendulum").document}
INSIDE = {"T1": 253.0, "T2": 203.0, "T3": 152.0, "T4": 100.0, "MCL": 0.022, "ACL": 0.009, "PCL": 0.0042}
GOOD_QUALITY = Quality(
    verdict="pass",
    energy_error_percent=0.1,
    joint_gap_mm=0.001,
    step_change_percent=0.1,
    steps=1,
    time_step=1e-5,
)


def pendulum(**changed: float | None):
    peaks = {**INSIDE, **changed}
    return recording({name: bump(peak) * 1.0 for name, peak in peaks.items() if peak is not None})


def sheet_result(values, **more):  # noqa: ANN001, ANN003  # as grade takes
    return grade(SHEET, WINDOW, recording({"T1": values}), **more)


def test_a_value_inside_its_corridor_passes():
    result = sheet_result(bump(250.0))
    found = only(result)
    assert (result.verdict, found.verdict) == ("pass", "pass")
    assert found.margin == pytest.approx(15.0)
    assert (found.lower, found.upper, found.unit) == (235.0, 272.0, "N·m")
    assert (found.confidence, found.source) == ("verified", "made up for this test")


@pytest.mark.parametrize("peak", [234.9, 272.1])
def test_a_value_outside_its_corridor_fails(peak: float):
    assert sheet_result(bump(peak)).verdict == "fail"


def test_a_missing_channel_is_not_evaluated():
    result = grade(SHEET, WINDOW, recording({"T2": bump(250.0)}))
    assert result.verdict == "not evaluated"
    assert only(result).value is None
    assert any("`T1` was not recorded" in remark for remark in result.remarks)


@pytest.mark.parametrize("corridors", [{}, corridor_set(windows={"T2": {"upper": "1 N·m"}})])
def test_a_missing_corridor_is_not_evaluated(corridors: dict):
    result = grade(SHEET, corridors, recording({"T1": bump(250.0)}))
    assert result.verdict == "not evaluated"
    assert only(result).graded
    assert only(result).value == pytest.approx(250.0)


def test_an_awaited_corridor_makes_a_criterion_informative():
    waiting = corridor_set(awaited={"T1": "nobody knows it"})
    result = grade(SHEET, waiting, recording({"T1": bump(250.0)}))
    assert result.verdict == "not evaluated"
    assert not only(result).graded
    assert "no criterion has a corridor" in result.remarks[0]


def test_an_informative_criterion_does_not_spoil_a_pass_and_is_named():
    sheet = procedure({"id": "T1", "corridor": "set/T1"}, {"id": "F1"})
    result = grade(sheet, WINDOW, recording({"T1": bump(250.0), "F1": bump(1e4)}))
    assert result.verdict == "pass"
    assert any(remark.startswith("Does not cover F1") for remark in result.remarks)


def test_one_criterion_outside_fails_the_whole_pendulum_test():
    assert grade(PENDULUM, PENDULUM_CORRIDORS, pendulum()).verdict == "pass"
    assert grade(PENDULUM, PENDULUM_CORRIDORS, pendulum(T3=180.0)).verdict == "fail"


def test_a_missing_t1_leaves_the_whole_pendulum_test_not_evaluated():
    result = grade(PENDULUM, PENDULUM_CORRIDORS, pendulum(T1=None))
    assert result.verdict == "not evaluated"


def test_a_failure_outweighs_a_missing_channel():
    assert grade(PENDULUM, PENDULUM_CORRIDORS, pendulum(T1=None, T2=300.0)).verdict == "fail"


def test_a_recalled_corridor_is_remarked_next_to_the_verdict():
    known = PENDULUM_CORRIDORS["r127-pendulum"]
    recalled = {name: w.model_copy(update={"confidence": "recalled"}) for name, w in known.windows.items()}
    result = grade(PENDULUM, {"r127-pendulum": known.model_copy(update={"windows": recalled})}, pendulum())
    assert any("not verified against the regulation's text" in remark for remark in result.remarks)


def test_verified_corridors_need_no_remark():
    codes = {remark.code for remark in sheet_result(bump(250.0)).coded_remarks}
    assert not any(code.startswith("rests-on") for code in codes)


def test_an_untrusted_run_is_an_error_whatever_it_says():
    bad = GOOD_QUALITY.model_copy(update={"verdict": "error"})
    assert sheet_result(bump(250.0), quality=bad).verdict == "error"
    assert sheet_result(bump(250.0), quality=GOOD_QUALITY).verdict == "pass"


def test_a_failed_check_leaves_the_test_not_evaluated_with_the_reason():
    expired = PreconditionResult(
        quantity="sensor 12", value=-3.0, unit="d", lower=0.0, verdict="fail", reason="sensor 12 has expired"
    )
    result = sheet_result(bump(250.0), checks=(expired,))
    assert result.verdict == "not evaluated"
    assert only(result).verdict == "pass"
    assert "Not evaluated: sensor 12 has expired." in result.remarks


def test_within_the_guard_band_is_conditional():
    result = sheet_result(bump(237.0), decision=DecisionRule(1.0), uncertainties={"T1": 4.0})
    found = only(result)
    assert (result.verdict, found.verdict) == ("conditional", "conditional")
    assert found.uncertainty.guard_band == 4.0
    assert found.uncertainty.false_accept == pytest.approx(0.1587, abs=1e-3)
    assert result.decision_rule.startswith("guard band")


def test_uncertainties_are_shown_in_the_criterions_unit():
    corridors = corridor_set(windows={"MCL": {"lower": "20 mm", "upper": "24 mm"}})
    sheet = procedure({"id": "MCL", "corridor": "set/MCL"})
    result = grade(
        sheet,
        corridors,
        recording({"MCL": bump(0.0202)}),
        decision=DecisionRule(1.0),
        uncertainties={"MCL": 5e-4},
    )
    found = only(result)
    assert found.verdict == "conditional"
    assert found.uncertainty.expanded == pytest.approx(0.5)
    assert found.margin == pytest.approx(0.2)


def test_nearer_to_the_limit_than_the_numerical_uncertainty_is_conditional():
    result = sheet_result(bump(235.5), numerical={"T1": 1.0})
    assert result.verdict == "conditional"
    assert "numerical uncertainty of 1 N·m" in only(result).reason
    assert sheet_result(bump(237.0), numerical={"T1": 1.0}).verdict == "pass"


def test_a_corridor_in_the_wrong_unit_is_an_error_of_the_definitions():
    wrong = corridor_set(windows={"T1": {"upper": "272 mm"}})
    with pytest.raises(UsageError, match="corridor set/T1: `272 mm` has the unit `mm`"):
        grade(SHEET, wrong, recording({"T1": bump(250.0)}))


def test_a_corridor_may_be_written_in_another_unit_of_its_kind():
    metres = corridor_set(windows={"T1": {"upper": "0.272 kN·m"}})
    assert only(grade(SHEET, metres, recording({"T1": bump(250.0)}))).upper == pytest.approx(272.0)


def test_a_corridor_of_the_wrong_kind_is_an_error_of_the_definitions():
    band = corridor_set(bands={"T1": {"upper": [("0 ms", "1 N·m"), ("1 ms", "1 N·m")]}})
    with pytest.raises(UsageError, match="`max` needs a window, but set/T1 is a band"):
        grade(SHEET, band, recording({"T1": bump(250.0)}))


def test_simulated_and_measured_tests_are_titled_apart():
    measured = grade(SHEET, WINDOW, recording({"T1": bump(250.0)}, kind="measured"))
    assert measured.kind == "test evaluation"
    assert sheet_result(bump(250.0)).kind == "virtual certification"
    for result in (measured, sheet_result(bump(250.0))):
        assert "not a calibration certificate" in result.remarks[-1]


def test_the_same_samples_give_the_same_values_simulated_or_measured():
    rec = pendulum()
    simulated = grade(PENDULUM, PENDULUM_CORRIDORS, rec)
    measured = grade(PENDULUM, PENDULUM_CORRIDORS, replace(rec, kind="measured"))
    for one, other in zip(simulated.criteria, measured.criteria, strict=True):
        assert one.value == other.value


def test_a_measured_test_without_its_temperature_is_not_evaluated():
    result = grade(PENDULUM, PENDULUM_CORRIDORS, replace(pendulum(), kind="measured"))
    assert result.verdict == "not evaluated"
    assert any("temperature was not recorded" in remark for remark in result.remarks)


def test_a_swapped_wire_is_refused_and_turned_when_lenient():
    swapped = replace(pendulum(T1=-253.0), kind="measured")
    with pytest.raises(DataError, match="`T1` has its polarity swapped"):
        grade(PENDULUM, PENDULUM_CORRIDORS, swapped)
    result = grade(PENDULUM, PENDULUM_CORRIDORS, swapped, lenient=True)
    assert result.criteria[0].value > 200
    assert any("T1: sign turned" in note for note in result.notes)


VEHICLE = load("procedure", "vehicle").document
VEHICLE_CORRIDORS = {name: load("corridors", name).document for name in ("r127-vehicle", "euro-ncap-2014")}


def impact(*, without: str | None = None):
    """Return a vehicle test with a hill of 100 N·m and a rebound of 300 N·m in every bone."""
    bones = dict.fromkeys(
        ("F1", "F2", "F3", "T1", "T2", "T3", "T4"), bump(100.0, at=0.02) - bump(300.0, at=0.058)
    )
    ligaments = {"MCL": bump(0.012, at=0.02), "ACL": bump(0.005, at=0.02), "PCL": bump(0.003, at=0.02)}
    return recording({name: values for name, values in (bones | ligaments).items() if name != without})


def test_a_vehicle_test_is_judged_within_its_assessment_interval():
    result = grade(VEHICLE, VEHICLE_CORRIDORS, impact())
    t1 = next(c for c in result.criteria if c.id == "T1")
    assert t1.value == pytest.approx(100.0, rel=0.05)
    assert result.interval[1] == pytest.approx(0.04, abs=0.003)
    assert {score.id: score.points for score in result.scores} == {"tibia": 0.5, "knee": 0.5}


def test_without_one_bone_moment_there_is_no_assessment_interval():
    result = grade(VEHICLE, VEHICLE_CORRIDORS, impact(without="F2"))
    assert result.verdict == "not evaluated"
    assert result.interval is None
    assert result.criteria[0].reason == "no assessment interval: channel `F2` was not recorded"


def test_corridors_and_scores_for_another_impactor_hold_nothing():
    other = corridor_set(impactor="aPLI", windows={"T1": {"upper": "320 N·m"}})
    result = grade(SHEET, other, recording({"T1": bump(250.0)}))
    assert only(result).verdict == result.verdict == "not evaluated"
    assert only(result).reason == "the corridor set `set` is for the aPLI"
    apli = {**VEHICLE_CORRIDORS, "euro-ncap-2014": load("corridors", "euro-ncap-2026").document}
    assert "Scores are not given: `euro-ncap-2014` is for the aPLI." in grade(VEHICLE, apli, impact()).remarks


def test_the_notes_of_corridors_and_filters_are_told():
    notes = grade(VEHICLE, VEHICLE_CORRIDORS, impact()).notes
    relaxed = {"corridor": "r127-vehicle/tibia-relaxed"}
    criteria = [c.model_copy(update=relaxed) if c.id == "T1" else c for c in VEHICLE.criteria]
    told = grade(VEHICLE.model_copy(update={"criteria": criteria}), VEHICLE_CORRIDORS, impact()).notes
    assert any(note.startswith("T1: Holds over widths") for note in told)
    assert any(note.startswith("Filters: ISO 6487") for note in notes)


def test_criterion_values_are_those_of_the_result():
    rec = pendulum()
    result = grade(PENDULUM, PENDULUM_CORRIDORS, rec)
    assert criterion_values(measure_all(PENDULUM, rec)) == {c.id: c.value for c in result.criteria}


@settings(max_examples=60, deadline=None)
@given(
    peak=st.floats(-1e4, 1e4) | st.sampled_from([math.nan, math.inf, -math.inf]),
    lower=st.none() | st.floats(-1e3, 1e3),
    height=st.none() | st.floats(0, 1e3),
    ratio=st.sampled_from([0.0, 1.0]),
    expanded=st.none() | st.floats(0, 100),
)
def test_a_verdict_is_never_pass_for_a_value_that_is_no_number_or_outside(
    peak: float, lower: float | None, height: float | None, ratio: float, expanded: float | None
):
    upper = None if height is None else (lower or 0.0) + height
    limits = {k: f"{v!r} N·m" for k, v in (("lower", lower), ("upper", upper)) if v is not None}
    corridors = corridor_set(windows={"T1": limits}) if limits else {}
    values = np.full(TIME.size, peak)
    result = grade(
        SHEET,
        corridors,
        recording({"T1": values}),
        decision=DecisionRule(ratio),
        uncertainties={} if expanded is None else {"T1": expanded},
    )
    if result.verdict == "pass":
        assert math.isfinite(peak)
        assert limits
        assert lower is None or peak >= lower
        assert upper is None or peak <= upper
        assert ratio == 0 or expanded is not None


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(sorted(INSIDE)), st.sampled_from(["missing", "nan", "empty set"]))
def test_a_pendulum_test_never_passes_with_anything_missing(channel: str, how: str):
    rec = pendulum(**{channel: None}) if how == "missing" else pendulum()
    corridors = dict(PENDULUM_CORRIDORS)
    if how == "nan":
        rec.channels[channel].values[17] = math.nan
    if how == "empty set":
        windows = {k: v for k, v in corridors["r127-pendulum"].windows.items() if k != channel}
        corridors["r127-pendulum"] = corridors["r127-pendulum"].model_copy(update={"windows": windows})
    result = grade(PENDULUM, corridors, rec)
    assert result.verdict != "pass"
    assert next(c for c in result.criteria if c.id == channel).verdict == "not evaluated"


def test_a_corridor_that_the_procedure_leaves_out_is_named():
    pendulum = load("procedure", "pendulum").document
    corridors = {"r127-pendulum": load("corridors", "r127-pendulum").document}
    assert left_ungraded(pendulum, corridors) == []
    without = pendulum.model_copy(update={"criteria": [c for c in pendulum.criteria if c.id != "T3"]})
    (reason,) = left_ungraded(without, corridors)
    assert (reason.code, reason.parameters["entries"]) == ("corridor-not-graded", ["T3"])
