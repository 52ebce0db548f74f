"""Schemes: limits with relaxed zones, points on sliding scales, rules for points without a value."""

from __future__ import annotations

import random

import pytest
from support.synthetic_campaign import campaign, point, source, terms

from certkit.documents.verdicts import worst
from certkit.errors import UsageError
from certkit.grading.judge_car import judge_car
from certkit.grading.prediction_agreement import agreement
from certkit.grading.quantities import in_unit
from certkit.reporting.language import worded


def judged(scheme: str, *points: object, symmetric: bool = True, **asked: object):
    return worded(judge_car(terms(scheme, **asked), points, symmetric=symmetric))


def test_a_limit_itself_passes_and_one_beyond_fails():
    row, over = judged("r127", point("a", 0, source(T1=340.0)), point("b", 100, source(T1=340.01))).points
    assert (row.verdict, row.worst, row.percent) == ("pass", "T1", pytest.approx(100.0))
    assert (over.verdict, over.worst) == ("fail", "T1")


def test_a_relaxed_zone_has_the_higher_limit_for_the_tibia_alone():
    inside = point("a", 0, source(T1=379.0, MCL=22.1), relaxed=True)
    (row,) = judged("r127", inside).points
    verdicts = {each.id: each.verdict for each in row.criteria}
    assert (verdicts["T1"], verdicts["MCL"]) == ("pass", "fail")
    (row,) = judged("r127", point("a", 0, source(T1=379.0))).points
    assert row.verdict == "fail"


def test_by_the_regulation_no_point_stands_for_another():
    found = judged("r127", point("a", -100, source()), point("b", 100))
    assert [row.verdict for row in found.points] == ["pass", "not evaluated"]
    assert found.verdict == "not evaluated"
    assert found.worst_point == "a"


def test_the_other_side_of_a_symmetric_car_stands_for_an_untested_point():
    points = (point("a", -100, source(T1=311.0)), point("b", 0, source()), point("c", 100))
    found = judged("euro-ncap-flex-pli", *points)
    assert (found.points[2].basis, found.points[2].of) == ("mirrored", "a")
    assert found.points[2].points == found.points[0].points == pytest.approx(0.75)
    other = judged("euro-ncap-flex-pli", *points, symmetric=False).points[2]
    assert (other.basis, other.of) == ("neighbour", "b")


def test_the_worse_neighbour_stands_for_a_point_between():
    points = (point("a", -100, source(T1=300.0)), point("b", 0), point("c", 100, source(T1=330.0)))
    row = judged("euro-ncap-flex-pli", *points).points[1]
    assert (row.basis, row.of) == ("neighbour", "c")


def test_the_total_is_shared_out_evenly_over_the_points():
    points = (point("a", 0, source()), point("b", 100, source(T1=311.0)), point("c", 200, source(ACL=10.0)))
    found = judged("euro-ncap-flex-pli", *points, at_least=4.5)
    assert [row.points for row in found.points] == pytest.approx([1.0, 0.75, 0.5])
    assert (found.total, found.maximum, found.verdict) == (pytest.approx(4.5), 6.0, "pass")
    assert judged("euro-ncap-flex-pli", *points, at_least=4.6).verdict == "fail"
    assert judged("euro-ncap-flex-pli", *points).verdict is None


def test_the_total_of_2026_is_the_sum_of_its_scores_car_points():
    values = {"F1": 300.0, "F2": 300.0, "F3": 300.0}
    points = (point("a", 0, source(**values)), point("b", 100, source(**values | {"T1": 400.0})))
    found = judged("euro-ncap-2026", *points)
    assert found.maximum == 7.5
    assert found.total == pytest.approx(2.5 + 5 * 0.5)


def test_in_2026_an_untested_point_takes_the_larger_value_of_each_criterion():
    femur = {"F1": 300.0, "F2": 300.0, "F3": 300.0}
    points = (
        point("a", 0, source(**femur | {"T1": 310.0, "MCL": 20.0})),
        point("b", 100),
        point("c", 200),
        point("d", 300, source(**femur | {"T1": 200.0, "MCL": 31.0})),
    )
    found = judged("euro-ncap-2026", *points)
    for row in found.points[1:3]:
        values = {each.id: each.value for each in row.criteria}
        assert (row.basis, row.of) == ("neighbour", "a and d")
        assert (values["T1"], values["MCL"]) == (310.0, 31.0)
    mirrored = judged("euro-ncap-2026", point("a", -100, source(**femur)), point("c", 100))
    assert (mirrored.points[1].basis, mirrored.points[1].of) == ("mirrored", "a")


def test_a_value_that_is_missing_never_passes_and_earns_nothing():
    (row,) = judged("r127", point("a", 0, source(T1=None))).points
    assert (row.verdict, row.reason) == ("not evaluated", "T1: no value")
    (row,) = judged("euro-ncap-flex-pli", point("a", 0, source(T1=None))).points
    assert row.points == pytest.approx(0.5)
    assert "T1" in row.reason


def test_a_test_that_does_not_count_is_not_replaced_by_a_prediction():
    lost = source("measured").model_copy(update={"usable": False, "reason": "too warm"})
    (row,) = judged("r127", point("a", 0, lost, source("predicted"))).points
    assert (row.verdict, row.reason, row.source) == ("not evaluated", "too warm", "measured")


def test_targets_are_shares_of_the_limits():
    (row,) = judged("r127", point("a", 0, source(MCL=18.0)), share=0.8, own_targets=True).points
    assert (row.verdict, row.worst) == ("fail", "MCL")
    assert row.criteria[4].limit == pytest.approx(17.6)


def test_a_value_in_the_guard_band_is_conditional():
    near = source("measured")
    values = [v.model_copy(update={"value": 21.8, "guard": 0.4}) if v.id == "MCL" else v for v in near.values]
    (row,) = judged("r127", point("a", 0, near.model_copy(update={"values": values}))).points
    assert row.verdict == "conditional"


def test_the_verdict_is_that_of_the_worst_point_for_random_values():
    chance = random.Random(7)  # noqa: S311  # no secret
    for _ in range(50):
        points = [
            point(f"p{i}", 100.0 * i, source(T1=chance.uniform(300, 380), MCL=chance.uniform(19, 25)))
            for i in range(5)
        ]
        found = judged("r127", *points)
        assert found.verdict == worst(row.verdict for row in found.points)
        most = max(max(r.percent or 0 for r in row.criteria) for row in found.points)
        assert next(r.percent for r in found.points if r.point == found.worst_point) == pytest.approx(most)


def test_errors_of_a_prediction_are_relative_to_it():
    rows = agreement([point("a", 0, source("measured", T1=220.0), source("predicted"))], {"T1"}, 5.0)
    (row,) = rows
    assert (row.error_percent, row.within) == (pytest.approx(10.0), False)
    assert agreement([point("a", 0, source("predicted"))], {"T1"}, 5.0) == []


def test_a_quantity_of_another_kind_is_refused():
    with pytest.raises(UsageError, match="cannot be given in mm"):
        in_unit("340 N·m", "mm", "MCL")


def test_what_a_judgement_rests_on_is_said():
    said = " ".join(campaign().schemes[1].remarks)
    assert "a lumped simulation at L+1" in said
    assert "the worse neighbour stands for =L+3 (of L+2)" in said
