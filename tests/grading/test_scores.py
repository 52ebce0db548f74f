"""Points on sliding scales."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certkit.definitions.loading.library import load
from certkit.documents.result import CriterionResult
from certkit.errors import UsageError
from certkit.grading.scores import grade_scores, points
from certkit.reasons import Reason

EURO_NCAP = load("corridors", "euro-ncap-2014").document.scores


def criteria(**values: float | None) -> dict[str, CriterionResult]:
    return {
        name: CriterionResult(
            id=name, title=name, value=value, unit="N·m" if name.startswith("T") else "mm", verdict="pass"
        )
        for name, value in values.items()
    }


CALM = {"T1": 200.0, "T2": 180.0, "T3": 150.0, "T4": 100.0, "MCL": 15.0, "ACL": 5.0, "PCL": 4.0}


def earned(**values: float | None):
    return {score.id: score for score in grade_scores(EURO_NCAP, criteria(**{**CALM, **values}))[0]}


def test_values_under_the_full_mark_earn_all_points():
    assert {name: score.points for name, score in earned().items()} == {"tibia": 0.5, "knee": 0.5}


def test_half_way_down_the_scale_earns_half():
    assert earned(T2=311.0)["tibia"].points == pytest.approx(0.25)


def test_at_the_zero_mark_nothing_is_left():
    assert earned(T1=340.0)["tibia"].points == 0.0


def test_the_worst_criterion_decides_and_is_named():
    tibia = earned(T3=320.0, T1=290.0)["tibia"]
    assert (tibia.criterion, tibia.value) == ("T3", 320.0)


def test_a_cruciate_ligament_at_10_mm_forfeits_the_knees_points():
    assert earned(ACL=10.0)["knee"].points == 0.0
    assert earned(ACL=9.99)["knee"].points == 0.5
    assert earned(PCL=12.0)["knee"].criterion == "PCL"


def test_a_missing_value_earns_nothing_and_is_named():
    scores, remarks = grade_scores(EURO_NCAP, criteria(**{**CALM, "T4": None}))
    assert [score.id for score in scores] == ["knee"]
    assert remarks == [Reason.of("score-not-measured", score="tibia", criteria=["T4"])]


def test_a_score_in_another_kind_of_unit_is_refused():
    wrong = criteria(**CALM) | criteria(MCL=15.0)
    wrong["T1"] = wrong["T1"].model_copy(update={"unit": "mm"})
    with pytest.raises(UsageError, match="`282 N·m` cannot be given in mm"):
        grade_scores(EURO_NCAP, wrong)


@given(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4), st.floats(-1e3, 1e3), st.floats(1e-3, 1e3))
def test_more_never_earns_more(a: float, b: float, full: float, width: float):
    low, high = sorted((a, b))
    assert points(low, full, full + width, 1.0) >= points(high, full, full + width, 1.0)
    assert 0.0 <= points(a, full, full + width, 1.0) <= 1.0
