"""Euro NCAP 2026 with the aPLI: points in bands, half-up rounding, and the worst criterion of a region."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.definitions.loading.library import load
from certkit.documents.result import CriterionResult
from certkit.grading.criterion import Judgement, grade_criterion
from certkit.grading.half_up import half_up
from certkit.grading.measured_value import MeasuredValue
from certkit.grading.scores import grade_scores

SCORES = load("corridors", "euro-ncap-2026").document.scores
LIMITS = {"F": (390.0, 440.0), "T": (275.0, 320.0), "M": (27.0, 32.0)}
CALM = {
    **dict.fromkeys(("F1", "F2", "F3"), 200.0),
    **dict.fromkeys(("T1", "T2", "T3", "T4"), 150.0),
    "MCL": 12.0,
}


def earned(**values: float) -> dict[str, tuple[float, str, str]]:
    criteria = {
        name: CriterionResult(
            id=name, title=name, value=value, unit="mm" if name == "MCL" else "N·m", verdict="pass"
        )
        for name, value in {**CALM, **values}.items()
    }
    return {s.id: (s.points, s.colour, s.criterion) for s in grade_scores(SCORES, criteria)[0]}


# Read from Euro NCAP's rating program 5.4.9: value → share of the points.
@pytest.mark.parametrize(
    ("criterion", "value", "share", "colour"),
    [
        ("T1", 274.99, 1.0, "green"),
        ("T1", 274.994, 1.0, "green"),
        ("T1", 274.995, 0.75, "yellow"),  # rounded half up to the limit, which earns no longer all
        ("T2", 275.0, 0.75, "yellow"),
        ("T3", 289.99, 0.75, "yellow"),
        ("T3", 290.0, 0.5, "orange"),
        ("T4", 304.99, 0.5, "orange"),
        ("T4", 305.0, 0.25, "brown"),
        ("T1", 319.99, 0.25, "brown"),
        ("T1", 320.0, 0.0, "red"),
        ("MCL", 26.99, 1.0, "green"),
        ("MCL", 27.0, 0.75, "yellow"),
        ("MCL", 28.66, 0.75, "yellow"),
        ("MCL", 28.665, 0.5, "orange"),  # a third of the range ends at 28.67
        ("MCL", 30.32, 0.5, "orange"),
        ("MCL", 30.33, 0.25, "brown"),
        ("MCL", 32.0, 0.0, "red"),
        ("F1", 389.99, 1.0, "green"),
        ("F1", 390.0, 0.75, "yellow"),
        ("F2", 406.67, 0.5, "orange"),
        ("F3", 423.33, 0.25, "brown"),
        ("F3", 440.0, 0.0, "red"),
    ],
)
def test_a_value_earns_the_share_of_its_band(criterion: str, value: float, share: float, colour: str):
    region = "femur" if criterion.startswith("F") else "knee and tibia"
    assert earned(**{criterion: value})[region] == (share, colour, criterion)
    other = "knee and tibia" if region == "femur" else "femur"
    assert earned(**{criterion: value})[other][0] == 1.0


def test_knee_and_tibia_have_the_worse_of_ligament_and_moment():
    assert earned(T2=300.0, MCL=31.0)["knee and tibia"] == (0.25, "brown", "MCL")
    assert earned(T2=330.0, MCL=31.0)["knee and tibia"] == (0.0, "red", "T2")


def test_halves_go_up_whatever_the_binary_number_is():
    assert [half_up(v, 2) for v in (0.075, 27.005, 28.665, 274.995, -0.075)] == [
        0.08,
        27.01,
        28.67,
        275.0,
        -0.08,
    ]
    assert half_up(float("inf"), 2) == float("inf")


def test_at_the_lower_performance_limit_a_criterion_fails_and_below_it_passes():
    procedure = load("procedure", "vehicle-apli").document
    table = load("legform", "apli").document.channel_table
    sets = {"euro-ncap-2026": load("corridors", "euro-ncap-2026").document}
    criterion = next(c for c in procedure.criteria if c.id == "MCL")

    def verdict(mm: float) -> str:
        measured = MeasuredValue(mm * 1e-3, 0.02, table.kinds["MCL"].dimension)
        return grade_criterion(criterion, measured, Judgement(sets, channels=table)).verdict

    assert [verdict(mm) for mm in (31.99, 31.9949, 31.9951, 32.0, 32.01)] == [
        "pass",
        "pass",
        "fail",
        "fail",
        "fail",
    ]


def test_points_are_those_of_euro_ncaps_own_program():
    reason = "euroncap-rating-2026 is Euro NCAP's own program: an oracle, not a dependency"
    oracle = pytest.importorskip("euroncap_rating_2026.crash_protection.criteria", reason=reason)
    weights = {"green": 1.0, "yellow": 0.75, "orange": 0.5, "brown": 0.25, "red": 0.0}

    def share(name: str, value: float) -> float:
        full, zero = LIMITS[name[0]]
        criterion = oracle.Criteria(name=name, hpl=full, lpl=zero, criteria_type=oracle.CriteriaType.CRITERIA)
        criterion.set_value(value)
        return weights[criterion.color]

    draw = np.random.default_rng(2026)
    for _ in range(200):
        values = {}
        for name in CALM:
            full, zero = LIMITS[name[0]]
            edge = full + draw.integers(4) * (zero - full) / 3
            near = (edge, half_up(edge, 2), half_up(edge, 2) + draw.choice((-0.01, -0.005, 0.005, 0.01)))
            values[name] = draw.choice((*near, draw.uniform(0.5 * full, 1.2 * zero)))
        found = earned(**values)
        assert found["femur"][0] == min(share(n, v) for n, v in values.items() if n[0] == "F"), values
        assert found["knee and tibia"][0] == min(share(n, v) for n, v in values.items() if n[0] != "F"), (
            values
        )
