"""The result document: the same bytes every time, read back as written, damaged files refused clearly."""

from __future__ import annotations

import json
import math
import warnings
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.sheets import PROVENANCE, TIME, bump, corridor_set, grade, procedure, recording

from certkit.documents.channel_curves import drawn_curves, raw_channels, recording_of, thinned
from certkit.documents.result import Quality, QualityCheck, Result
from certkit.documents.rounding import rounded, rounded_all, rounded_series
from certkit.errors import DataError, UsageError
from certkit.grading import exit_code, with_spread, worst
from certkit.reasons import Reason
from certkit.reporting.language import worded
from certkit.signals import Filtered

if TYPE_CHECKING:
    from pathlib import Path

WINDOW = corridor_set(windows={"T1": {"lower": "235 N·m", "upper": "272 N·m"}})
SHEET = procedure({"id": "T1", "corridor": "set/T1", "filter": "CFC 180"})
QUALITY = Quality(
    verdict="pass",
    energy_error_percent=0.1,
    joint_gap_mm=0.001,
    step_change_percent=0.1,
    steps=1,
    time_step=1e-5,
    solver_seconds=0.25,
)


def result(peak: float = 250.0, **more: object) -> Result:
    return grade(
        SHEET, WINDOW, recording({"T1": bump(peak), "MCL": bump(0.02)}), **{"quality": QUALITY, **more}
    )


def test_the_text_is_json_in_the_schemas_order_with_a_line_for_each_criterion():
    text = result().to_json()
    tree = json.loads(text)
    assert list(tree) == [info.alias or name for name, info in Result.model_fields.items()]
    assert text.endswith("}\n")
    assert sum(line.startswith('    {"id":"T1"') for line in text.splitlines()) == 1


def test_the_id_does_not_know_the_clock_or_the_machine():
    slow = QUALITY.model_copy(update={"solver_seconds": 99.0})
    elsewhere = PROVENANCE.model_copy(update={"packages": {"numpy": "9.9"}})
    base = result()
    assert result(quality=slow).id == base.id
    assert base.model_copy(update={"provenance": elsewhere, "id": ""}).model_copy() is not None
    assert base.model_copy(update={"provenance": elsewhere}).content_id() == base.id


def test_the_id_knows_every_number():
    assert result(250.0).id != result(250.001).id
    assert len(result().id) == 19


def test_the_schema_describes_what_is_written():
    jsonschema = pytest.importorskip("jsonschema")
    schema = Result.model_json_schema(by_alias=True)
    jsonschema.validate(json.loads(result().to_json()), schema)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "damaged"),
        ("{", "damaged"),
        ('{"schema": "certkit-result/1"', "damaged"),
        ("[]", "not a certkit result"),
        ("{}", "not a certkit result"),
        ('{"schema": "certkit-result/9"}', "not a certkit result: schema"),
        ("null", "not a certkit result"),
        ("\x00\x01", "damaged"),
    ],
)
def test_a_damaged_document_is_refused_with_one_clear_line(text: str, said: str, tmp_path: Path):
    path = tmp_path / "result.json"
    path.write_text(text)
    with pytest.raises(DataError, match=said) as caught:
        Result.read(path)
    assert "\n" not in str(caught.value)
    assert str(path) in str(caught.value)


def test_a_document_with_one_field_too_many_is_refused():
    tree = json.loads(result().to_json())
    with pytest.raises(DataError, match="verdikt"):
        Result.from_json(json.dumps({**tree, "verdikt": "pass"}))


def test_a_verdict_that_is_none_is_refused():
    with pytest.raises(DataError, match="verdict"):
        Result.from_json(result().to_json().replace('"verdict":"pass"', '"verdict":"splendid"', 1))


@given(st.binary(max_size=300))
def test_no_bytes_whatsoever_do_anything_but_be_refused(data: bytes):
    with pytest.raises(DataError):
        Result.from_json(data)


def test_a_missing_file_says_what_to_do(tmp_path: Path):
    with pytest.raises(DataError, match=r"cannot be read \(No such file"):
        Result.read(tmp_path / "result.json")


def test_a_document_never_holds_what_is_no_number():
    with pytest.raises(ValueError, match="finite number"):
        Quality(**{**QUALITY.model_dump(), "energy_error_percent": math.nan})


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False), max_size=50))
def test_many_numbers_are_rounded_like_one(values: list[float]):
    for one, given_value in zip(rounded_all(values), values, strict=True):
        assert one == pytest.approx(rounded(given_value), rel=2e-7, abs=0)


@pytest.mark.parametrize("peak", [5e-324, 1e-300, 1e-290, 1e-6])
def test_a_channel_of_hardly_anything_is_rounded_without_a_complaint(peak: float):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert rounded_series([peak, 0.0, -peak]) == pytest.approx([peak, 0.0, -peak], rel=1e-6)


@given(st.floats(1e-12, 1e12))
def test_a_rounded_number_prints_in_seven_digits(value: float):
    (shown,) = rounded_all([value])
    digits = f"{shown:.17g}" if shown == float(f"{value:.7g}") else repr(shown)
    assert shown == pytest.approx(value, rel=1e-6)
    assert shown == float(f"{shown:.7g}"), digits


def test_a_recording_comes_back_out_of_its_document_and_grades_the_same():
    first = result()
    again = grade(SHEET, WINDOW, recording_of(first), quality=QUALITY)
    assert again.verdict == first.verdict
    assert again.criteria[0].value == pytest.approx(first.criteria[0].value, rel=1e-6)
    np.testing.assert_allclose(recording_of(first)["MCL"].values, bump(0.02), atol=1e-8)


def test_a_document_without_channels_cannot_be_graded_again():
    with pytest.raises(DataError, match="carries no channels"):
        recording_of(result().model_copy(update={"channels": None}))


def test_drawn_curves_are_few_and_keep_their_extremes():
    time = np.arange(20000) * 1e-5
    values = np.sin(2 * np.pi * 20 * time) * np.exp(-10 * time)
    drawn = drawn_curves(Filtered(recording({"T1": values}, time=time)), {}, 0.2)
    series = drawn.series["T1"].values
    assert drawn.count == len(series) <= 600
    assert max(series) == pytest.approx(values.max(), rel=1e-6)
    assert min(series) == pytest.approx(values.min(), rel=1e-6)
    peak = drawn.start + drawn.interval * int(np.argmax(series))
    assert peak == pytest.approx(time[np.argmax(values)], abs=drawn.interval)


@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=300), st.integers(1, 40))
def test_thinning_keeps_both_extremes_of_anything(values: list[float], stride: int):
    drawn = thinned(np.array(values), stride)
    assert drawn.size == -(-len(values) // stride)
    if drawn.size > 1:
        assert (drawn.min(), drawn.max()) == (min(values), max(values))
    else:
        assert abs(drawn[0]) == max(map(abs, values))


def test_a_peak_and_a_dip_between_two_drawn_samples_are_both_drawn():
    values = np.zeros(100)
    values[[51, 52]] = (-3.0, 5.0)
    for turned in (values, -values, values[::-1]):
        drawn = thinned(turned, 10)
        assert (drawn.min(), drawn.max()) == (turned.min(), turned.max())
        for index, value in enumerate(drawn):
            if value:
                assert abs(10 * index - int(np.flatnonzero(turned == value)[0])) <= 15


def test_drawn_curves_say_which_filter_they_have_seen():
    drawn = result().curves
    assert (drawn.series["T1"].filter, drawn.series["MCL"].filter) == ("CFC 180", "none")


def test_a_channel_with_nan_is_neither_drawn_nor_embedded():
    rec = recording({"T1": bump(250.0), "T2": np.full(TIME.size, np.nan)})
    assert set(raw_channels(rec).series) == {"T1"}
    assert set(drawn_curves(Filtered(rec), {}, 0.2).series) == {"T1"}


def test_raw_channels_keep_the_recordings_sampling():
    raw = result().channels
    assert (raw.count, raw.interval, raw.start) == (2001, pytest.approx(1e-4), 0.0)
    assert raw.series["MCL"].unit == "mm"


def test_the_worst_verdict_decides():
    assert worst(["pass", "conditional", "not evaluated"]) == "conditional"
    assert worst(["pass", "not evaluated"]) == "not evaluated"
    assert worst([]) == "not evaluated"


@pytest.mark.parametrize(
    ("verdicts", "code"),
    [
        (["pass"], 0),
        (["pass", "fail"], 1),
        (["conditional"], 1),
        (["not evaluated", "pass"], 4),
        (["not evaluated", "fail"], 1),
        (["error", "fail"], 3),
        ([], 4),
    ],
)
def test_exit_codes_are_the_contracts(verdicts: list[str], code: int):
    results = [result().model_copy(update={"verdict": verdict}) for verdict in verdicts]
    assert exit_code(results) == code


def test_not_evaluated_may_be_allowed_but_nothing_worse():
    results = [result().model_copy(update={"verdict": verdict}) for verdict in ("not evaluated", "pass")]
    assert exit_code(results, allow={"not evaluated"}) == 0
    failed = [*results, result().model_copy(update={"verdict": "fail"})]
    assert exit_code(failed, allow={"not evaluated"}) == 1


def test_a_family_gives_each_value_its_spread():
    family = with_spread([result(peak) for peak in (250.0, 240.0, 260.0)])
    spread = family.criteria[0].spread
    assert family.criteria[0].value == result(250.0).criteria[0].value
    assert spread.members == 3
    assert spread.minimum == pytest.approx(result(240.0).criteria[0].value)
    assert spread.mean == pytest.approx(result(250.0).criteria[0].value)
    assert spread.standard_deviation == pytest.approx((spread.maximum - spread.minimum) / 2)


def test_a_familys_verdict_is_the_nominal_legs_and_says_how_many_pass():
    family = worded(with_spread([result(250.0), result(250.0), result(300.0)]))
    assert family.verdict == "pass"
    assert any("3 certified legs (1 fail, 2 pass)" in remark for remark in family.remarks)
    assert "T1: 2 of 3 legs pass." in family.remarks
    assert family.id == family.content_id() != result(250.0).id


def test_a_family_names_the_legs_that_are_left_out_and_those_that_fail_by_number_and_why():
    check = QualityCheck(
        title="", coded_title=Reason.of("joint-gap"), value=1, limit=0.02, unit="mm", verdict="error"
    )
    broken = result(250.0).model_copy(
        update={"verdict": "error", "quality": QUALITY.model_copy(update={"checks": [check]})}
    )
    family = worded(with_spread([result(250.0), result(300.0), broken, result(251.0)]))
    assert family.criteria[0].spread.members == 3
    told = [remark for remark in family.remarks if "of the family" in remark]
    assert told == [
        "1 legs of the family could not be run to be trusted and are left out: number 2 (joint gap).",
        "1 legs of the family fail, and stay in the spread: number 1 (T1).",
    ]
    assert any("3 certified legs (1 fail, 2 pass)" in remark for remark in family.remarks)


def test_a_family_is_of_one_procedure_and_has_members():
    with pytest.raises(UsageError, match="at least one member"):
        with_spread([result()])
    with pytest.raises(UsageError, match="of several"):
        with_spread([result(), result().model_copy(update={"procedure": "other"})])
