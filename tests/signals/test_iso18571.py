"""The ISO/TS 18571 rating against the reference package, whose answers are kept as data."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from support.rated_pairs import PAIRS, TIME, Floats

from certkit.errors import DataError
from certkit.signals import rate, resampled
from certkit.signals.iso18571 import grade

EXPECTED = json.loads(
    (Path(__file__).parents[1] / "data" / "iso18571" / "objective-rating-metrics-1.3.json").read_text("utf-8")
)
SCORES = ("corridor", "phase", "magnitude", "slope", "overall")


@pytest.mark.parametrize("name", list(PAIRS))
def test_scores_equal_the_reference_packages_within_0_002(name: str):
    rating = rate(*PAIRS[name])
    for score in SCORES:
        assert getattr(rating, score) == pytest.approx(EXPECTED[name][score], abs=0.002), score


@pytest.mark.slow
def test_the_kept_answers_are_the_packages_own():
    package = pytest.importorskip("objective_rating_metrics.rating")
    for name, (reference, signal) in PAIRS.items():
        oracle = package.ISO18571(np.c_[TIME, reference], np.c_[TIME, signal])
        assert oracle.overall_rating(-1) == pytest.approx(EXPECTED[name]["overall"], abs=1e-9)


def test_a_curve_rates_itself_with_one():
    reference, _ = PAIRS["ringing"]
    rating = rate(reference, reference)
    assert all(getattr(rating, score) == 1.0 for score in SCORES)
    assert rating.grade == "excellent"


def test_a_straight_line_is_not_shifted_by_rounding():
    """All shifts correlate alike there; the smallest has to win."""
    assert rate(10 * TIME, 11 * TIME + 0.1).phase == 1.0


@pytest.mark.parametrize(
    ("overall", "word"),
    [
        (1.0, "excellent"),
        (0.95, "excellent"),
        (0.94, "good"),
        (0.81, "good"),
        (0.80, "fair"),
        (0.58, "poor"),
        (0.0, "poor"),
    ],
)
def test_grades_begin_above_their_thresholds(overall: float, word: str):
    assert grade(overall) == word


def test_scores_do_not_depend_on_the_unit():
    reference, signal = PAIRS["wider"]
    assert rate(1e-3 * reference, 1e-3 * signal).overall == pytest.approx(
        rate(reference, signal).overall, abs=1e-9
    )


@pytest.mark.parametrize(
    ("reference", "signal", "said"),
    [
        (np.zeros(100), np.zeros(99), "different lengths"),
        (np.arange(5.0), np.arange(5.0), "too few"),
        (np.full(100, np.nan), np.zeros(100), "not numbers"),
        (np.zeros(100), np.arange(100.0), "constant"),
    ],
)
def test_what_cannot_be_rated_is_refused(reference: Floats, signal: Floats, said: str):
    with pytest.raises(DataError, match=said):
        rate(reference, signal)


def test_a_constant_signal_is_rated_low_and_not_refused():
    reference, _ = PAIRS["equal"]
    rating = rate(reference, np.zeros_like(reference))
    assert rating.magnitude == 0
    assert (
        rating.grade == "fair"
    )  # most of a pulse is rest, and rest is easy to follow: the method's own weakness


def test_curves_are_brought_to_10_khz():
    time = np.linspace(-0.01, 0.1, 501)
    values = resampled(time, 3 * time, 0.0, 0.05)
    assert values.size == 501
    np.testing.assert_allclose(values, 3 * 1e-4 * np.arange(501), atol=1e-12)


def test_a_curve_that_does_not_cover_the_interval_is_refused():
    with pytest.raises(DataError, match="covers 0 to 40 ms, not 0 to 50 ms"):
        resampled(np.linspace(0, 0.04, 100), np.zeros(100), 0.0, 0.05)
