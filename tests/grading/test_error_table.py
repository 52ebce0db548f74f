"""The error table against the paper's Table 1, whose numbers are golden."""

from __future__ import annotations

import pytest

from certkit.definitions.loading.library import load
from certkit.definitions.reference import Reference
from certkit.documents.result import CriterionResult
from certkit.errors import UsageError
from certkit.grading.reference_errors import compare, error_percent, rms, whole_percent
from certkit.reasons import Reason

TABLE_1 = load("reference", "seed-table-1").document
PUBLISHED = {"F3": 52.0, "F2": 110.0, "F1": 165.0, "T1": 200.0, "T2": 150.0, "T3": 92.0, "T4": 40.0}
PRINTED = {"F3": -36, "F2": -13, "F1": 4, "T1": 3, "T2": 0, "T3": -9, "T4": -16}


def criteria(values: dict[str, float | None], unit: str = "N·m") -> list[CriterionResult]:
    return [
        CriterionResult(id=name, title=name, value=value, unit=unit, verdict="not evaluated", channel=name)
        for name, value in values.items()
    ]


def test_the_papers_own_simulation_gives_the_papers_own_errors():
    table = compare(TABLE_1, criteria(PUBLISHED))
    assert {row.channel: whole_percent(row.error_percent) for row in table.rows} == PRINTED
    assert {row.channel: row.published_error_percent for row in table.rows} == PRINTED


def test_the_papers_own_rms_error_is_16_2_percent():
    table = compare(TABLE_1, criteria(PUBLISHED))
    assert round(table.published_rms_error_percent, 1) == 16.2
    assert table.rms_error_percent == pytest.approx(16.124, abs=0.001)  # of the same errors before rounding


def test_a_simulation_that_meets_the_test_has_no_error():
    meets = {"F3": 81.0, "F2": 126.2, "F1": 158.3, "T1": 193.5, "T2": 149.7, "T3": 100.9, "T4": 47.8}
    table = compare(TABLE_1, criteria(meets))
    assert table.rms_error_percent == pytest.approx(0.0, abs=1e-12)
    assert [row.channel for row in table.rows] == list(meets)


def test_a_missing_channel_is_named_and_left_out_of_the_rms():
    table = compare(TABLE_1, criteria({**PUBLISHED, "F3": None}))
    assert "F3" not in [row.channel for row in table.rows]
    assert Reason.of("not-in-rms", criteria=["F3"]) in table.coded_notes


def test_without_any_channel_there_is_no_table():
    assert compare(TABLE_1, criteria({"MCL": 20.0}, unit="mm")) is None


def test_reference_values_may_be_written_in_another_unit():
    reference = Reference.model_validate(
        {
            "reference": "mine",
            "title": "mine",
            "origin": {"source": "made up", "confidence": "verified"},
            "values": {"MCL": "0.02 m"},
        }
    )
    (row,) = compare(reference, criteria({"MCL": 22.0}, unit="mm")).rows
    assert (row.test, row.unit) == (pytest.approx(20.0), "mm")
    assert row.error_percent == pytest.approx(10.0)


def test_a_reference_in_the_wrong_unit_is_refused():
    with pytest.raises(UsageError, match="reference seed-table-1, T1"):
        compare(
            TABLE_1,
            [CriterionResult(id="T1", title="T1", value=1.0, unit="mm", verdict="pass", channel="MCL")],
        )


@pytest.mark.parametrize(("error", "printed"), [(4.5, 5), (-4.5, -5), (0.49, 0), (-0.49, 0), (-35.8, -36)])
def test_errors_are_rounded_halves_away_from_zero(error: float, printed: float):
    assert whole_percent(error) == printed


def test_no_error_exists_against_zero():
    with pytest.raises(UsageError, match="no relative error"):
        error_percent(1.0, 0.0)


def test_rms_of_equal_errors_is_their_size():
    assert rms([3.0, -3.0, 3.0]) == pytest.approx(3.0)
