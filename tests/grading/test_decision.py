"""Decision rules: a value outside never passes, nor does one that is no number."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certkit.errors import UsageError
from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule, decide, false_accept
from certkit.reasons import Reason
from certkit.reporting.language import language

GUARDED = DecisionRule(1.0)
ANY = st.floats(allow_nan=True, allow_infinity=True)
LIMIT = st.none() | st.floats(-1e6, 1e6)


@pytest.mark.parametrize("value", [235.0, 250.0, 272.0])
def test_the_limits_belong_to_the_corridor(value: float):
    assert decide(SIMPLE_ACCEPTANCE, value, 235.0, 272.0).verdict == "pass"


@pytest.mark.parametrize("value", [math.nextafter(235.0, 0), math.nextafter(272.0, 300), -250.0])
def test_beyond_a_limit_by_the_last_bit_fails(value: float):
    decision = decide(SIMPLE_ACCEPTANCE, value, 235.0, 272.0)
    assert decision.verdict == "fail"
    assert decision.margin < 0


def test_the_margin_is_the_distance_to_the_nearer_limit():
    assert decide(SIMPLE_ACCEPTANCE, 250.0, 235.0, 272.0).margin == pytest.approx(15.0)
    assert decide(SIMPLE_ACCEPTANCE, 275.0, 235.0, 272.0).margin == pytest.approx(-3.0)
    assert decide(SIMPLE_ACCEPTANCE, 300.0, None, 340.0).margin == pytest.approx(40.0)


def test_inside_the_guard_band_is_conditional():
    decision = decide(GUARDED, 236.0, 235.0, 272.0, expanded=3.0)
    assert decision.verdict == "conditional"
    assert decision.guard_band == 3.0
    assert decide(GUARDED, 239.0, 235.0, 272.0, expanded=3.0).verdict == "pass"
    assert decide(GUARDED, 234.0, 235.0, 272.0, expanded=3.0).verdict == "fail"


def test_half_a_guard_band_is_half_as_wide():
    assert decide(DecisionRule(0.5), 237.0, 235.0, 272.0, expanded=3.0).verdict == "pass"


def test_a_guard_band_without_an_uncertainty_decides_nothing():
    decision = decide(GUARDED, 250.0, 235.0, 272.0)
    assert decision.verdict == "not evaluated"
    assert decision.reason == Reason.of("uncertainty-missing")


def test_on_the_limit_half_of_all_values_are_falsely_accepted():
    assert false_accept(340.0, None, 340.0, 4.0) == pytest.approx(0.5)


def test_a_whole_guard_band_leaves_a_risk_of_2_3_percent():
    """ILAC-G8: w = U keeps the specific risk under 2.5 %."""
    assert false_accept(336.0, None, 340.0, 4.0) == pytest.approx(0.02275, abs=1e-5)


def test_both_sides_of_a_narrow_corridor_add_up():
    assert false_accept(0.0, -1.0, 1.0, 2.0) == pytest.approx(2 * 0.158655, abs=1e-5)


def test_a_sure_measurement_has_no_risk():
    assert false_accept(250.0, 235.0, 272.0, 0.0) == 0.0
    assert false_accept(280.0, 235.0, 272.0, 0.0) == 1.0


@given(ANY, LIMIT, LIMIT, st.none() | ANY, st.sampled_from([0.0, 0.5, 1.0, 2.0]))
def test_nothing_outside_or_unknown_ever_passes(
    value: float, lower: float | None, upper: float | None, expanded: float | None, ratio: float
):
    verdict = decide(DecisionRule(ratio), value, lower, upper, expanded).verdict
    if verdict in {"pass", "conditional"}:
        assert math.isfinite(value)
        assert lower is not None or upper is not None
        assert lower is None or value >= lower
        assert upper is None or value <= upper
        assert expanded is None or math.isfinite(expanded)
        assert ratio == 0 or expanded is not None


@given(st.floats(-1e3, 1e3), st.floats(0, 100), st.floats(0, 100), st.floats(0, 2))
def test_a_guard_band_never_makes_a_verdict_better(value: float, room: float, expanded: float, ratio: float):
    order = ["pass", "conditional", "fail"]
    plain = decide(SIMPLE_ACCEPTANCE, value, -room, room, expanded).verdict
    guarded = decide(DecisionRule(ratio), value, -room, room, expanded).verdict
    assert order.index(guarded) >= order.index(plain)


@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(-1e3, 1e3), st.floats(0, 1e3))
def test_the_risk_is_a_probability(value: float, lower: float, upper: float, expanded: float):
    low, high = sorted((lower, upper))
    assert 0 <= false_accept(value, low, high, expanded) <= 1 + 1e-12


@pytest.mark.parametrize("ratio", [-0.1, math.nan, math.inf])
def test_a_guard_band_that_widens_the_limits_is_refused(ratio: float):
    with pytest.raises(UsageError, match="has to be 0 or more"):
        DecisionRule(ratio)


def test_the_rule_is_named_as_on_the_certificate():
    assert language().sentence(SIMPLE_ACCEPTANCE.reason) == "simple acceptance"
    assert language().sentence(GUARDED.reason) == "guard band w = 1·U (ILAC-G8:09/2019)"
