from __future__ import annotations

import io

import pytest

from certkit.documents.result import CriterionResult, Result
from certkit.reporting.result_view import unique_views
from certkit.reporting.text_table import bar, show


def row(value: float, lower: float | None = 90.0, upper: float | None = 111.0) -> CriterionResult:
    margins = ([value - lower] if lower is not None else []) + ([upper - value] if upper is not None else [])
    margin = min(margins)
    verdict = "pass" if margin >= 0 else "fail"
    return CriterionResult(
        id="T4", title="", value=value, unit="N·m", lower=lower, upper=upper, margin=margin, verdict=verdict
    )


@pytest.mark.parametrize("value", [90.0, 90.01, 100.0, 110.99, 111.0])
def test_a_value_inside_is_drawn_on_or_between_the_limits(value: float):
    drawn = bar(row(value))
    assert 4 <= drawn.index("●") <= 12


@pytest.mark.parametrize("value", [111.0001, 112.0, 1e9])
def test_a_value_above_is_drawn_beyond_the_upper_limit(value: float):
    drawn = bar(row(value))
    assert drawn.index("┤") < drawn.index("●")


@pytest.mark.parametrize("value", [89.9999, 80.0, -1e9])
def test_a_value_below_is_drawn_before_the_lower_limit(value: float):
    drawn = bar(row(value))
    assert drawn.index("●") < drawn.index("├")


def test_one_sided_limits_are_drawn_too():
    assert bar(row(100.0, lower=None)).index("●") < bar(row(100.0, lower=None)).index("┤")
    assert bar(row(150.0, upper=None)).index("├") < bar(row(150.0, upper=None)).index("●")


def test_a_pipe_gets_plain_lines_with_verdict_and_criteria(measured: Result):
    stream = io.StringIO()
    show(unique_views([measured]), stream)
    text = stream.getvalue()
    assert "\x1b" not in text
    assert "✗ FAIL" in text
    assert "channel ACL was not recorded" in text
    for criterion in measured.criteria:
        assert criterion.id in text


def test_several_results_are_first_shown_in_one_table(measured: Result, pendulum: Result):
    stream = io.StringIO()
    show(unique_views([pendulum, measured]), stream)
    lines = stream.getvalue().splitlines()
    assert lines[0].split()[:2] == ["verdict", "procedure"]
    assert lines[1].startswith("✓ pass")
    assert lines[2].startswith("✗ fail")
    nearest = unique_views([pendulum])[0].nearest_criterion
    assert nearest is not None
    assert nearest.id in lines[1]
    assert sum("Tibia" not in line and line.startswith("T4") for line in lines) == 2


def test_without_details_the_table_of_several_results_is_all(measured: Result, pendulum: Result):
    stream = io.StringIO()
    show(unique_views([pendulum, measured]), stream, details=False)
    assert len(stream.getvalue().splitlines()) == 3


def test_a_single_result_is_shown_with_its_criteria_all_the_same(pendulum: Result):
    shown = io.StringIO()
    show(unique_views([pendulum]), shown, details=False)
    assert all(criterion.id in shown.getvalue() for criterion in pendulum.criteria)


def test_a_test_without_corridors_has_no_worst_criterion(pendulum: Result):
    shown = [criterion.model_copy(update={"graded": False}) for criterion in pendulum.criteria]
    other = pendulum.model_copy(update={"criteria": shown, "verdict": "not evaluated"})
    stream = io.StringIO()
    show(unique_views([other, pendulum]), stream, details=False)
    assert stream.getvalue().splitlines()[1].split()[-2:] == ["–", "–"]


def test_brackets_in_data_are_text(pendulum: Result):
    stream = io.StringIO()
    show(unique_views([pendulum.model_copy(update={"title": "[red]odd[/red] [link]"})]), stream)
    assert "[red]odd[/red] [link]" in stream.getvalue()


@pytest.mark.parametrize("width", [64, 80, 200])
def test_the_table_of_several_cuts_no_column_but_leaves_out_whole_ones(
    pendulum: Result, measured: Result, bending: Result, monkeypatch: pytest.MonkeyPatch, width: int
):
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("COLUMNS", str(width))
    shown = io.StringIO()
    show(unique_views([pendulum, measured, bending]), shown, details=False)
    assert "…" not in shown.getvalue()
    assert "margin" in shown.getvalue()
    assert ("in corridor" in shown.getvalue()) == (width > 64)
