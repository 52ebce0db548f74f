from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certkit.documents.result import CriterionResult, Result
from certkit.grading.relative_margin import relative_margin
from certkit.reasons import Reason
from certkit.reporting import number_format as words
from certkit.reporting.html_report import suite_page
from certkit.reporting.language import language
from certkit.reporting.margins import margin_words, nearest_words, tally, worst
from certkit.reporting.result_view import unique_views
from certkit.reporting.suite_head import suite_head
from certkit.reporting.templating import folder


def criterion(**changes: object) -> CriterionResult:
    base = {"id": "T1", "title": "Tibia moment 1", "value": 271.0, "unit": "N·m", "lower": 235.0}
    base |= {"upper": 272.0, "margin": 1.0, "verdict": "pass"}
    return CriterionResult.model_validate(base | changes)


def test_minus_is_a_minus_sign_and_zero_has_none():
    assert words.fixed(-1.25, 1) == "−1.2"
    assert words.fixed(-0.001, 1) == "0.0"


@pytest.mark.parametrize(
    ("value", "digits", "text"),
    [
        (172.3, 2, "170"),
        (0.0996, 2, "0.10"),
        (1.04, 2, "1.0"),
        (-21.996, 4, "−22.00"),
        (0.0, 3, "0"),
        (3e-9, 2, "3.0e−09"),
    ],
)
def test_a_computed_number_keeps_its_digits_and_has_no_power(value: float, digits: int, text: str):
    assert words.significant(value, digits) == text


def test_a_difference_has_its_sign_and_a_zero_none():
    assert [words.signed(v, 1) for v in (0.26, -0.26, 0.02, -0.02, None)] == [
        "+0.3",
        "−0.3",
        "0.0",
        "0.0",
        "–",
    ]
    assert words.signed_significant(12.9, 4) == "+12.90"


@pytest.mark.parametrize("value", [None, math.nan, math.inf])
def test_what_is_no_number_is_a_dash(value: float | None):
    assert words.fixed(value, 1) == "–"


@given(excess=st.floats(1e-5, 10))
def test_a_value_beyond_its_limit_is_never_rounded_onto_it(excess: float):
    row = criterion(value=272.0 + excess, margin=-excess, verdict="fail")
    decimals = words.criterion_decimals(row)
    assert words.fixed(row.value, decimals) != words.fixed(row.upper, decimals)


def test_corridors_are_worded_by_their_sides():
    assert words.corridor(235.0, 272.0) == "235 – 272"
    assert words.corridor(None, 22.0) == "≤ 22"
    assert words.corridor(400.0, None) == "≥ 400"
    assert words.corridor(None, None) == "–"


def test_a_name_is_not_said_twice():
    assert words.named("MCL", "MCL elongation") == "MCL elongation"
    assert words.named("T1", "tibia moment 1") == "T1 tibia moment 1"


def test_the_margin_is_rated_by_half_the_corridor():
    assert relative_margin(criterion(margin=9.25)) == pytest.approx(0.5)
    assert relative_margin(criterion(lower=None, margin=27.2)) == pytest.approx(0.1)
    assert relative_margin(criterion(margin=None)) is None


def test_the_nearest_criterion_is_the_one_with_the_smallest_rated_margin(pendulum: Result, measured: Result):
    assert worst(pendulum).id == "T4"
    assert "22 % of the half-width" in margin_words(worst(pendulum))
    assert nearest_words(worst(pendulum)).startswith("Nearest to a limit: T4")
    assert nearest_words(worst(measured)).startswith("Furthest outside: T4")


def test_the_tally_counts_what_is_missing(measured: Result):
    assert tally(measured).startswith("4 of 7 graded criteria within corridor; 1 fail; 1 conditional; 1 not")


def test_a_sentence_writes_its_numbers_as_tables_do():
    said = [
        str(language().sentence(Reason.of("curve-size", peak=peak, area=area)))
        for peak, area in ((-0.2, 0.3), (-12.0, 7.0))
    ]
    assert said == ["its peak is 0 %, its area 0 %", "its peak is −12 %, its area +7 %"]


def test_templates_write_numbers_in_the_ways_of_number_format_alone():
    templates = sorted(folder().rglob("*.j2"))
    assert templates
    assert [path.name for path in templates if "|format(" in path.read_text("utf-8")] == []


def test_a_suite_names_first_what_did_not_pass_and_why(pendulum: Result, measured: Result, bending: Result):
    head = suite_head(unique_views([pendulum, measured, bending]))
    assert head.others[0].startswith("fail: pendulum – T4: ")
    assert "outside" in head.others[0]
    page = suite_page(unique_views([pendulum, measured, bending]))
    assert page.index("T4: ") < page.index("<table")
