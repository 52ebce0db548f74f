"""The part that was changed is found from the whole curves; what cannot be told apart is named together."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.changed_legs import CHANGES, changed, graded
from support.several_laboratories import certificate

from certkit import twin
from certkit.errors import DataError
from certkit.reporting.language import language
from certkit.reporting.twin_page import said, twin_page, twin_text


@pytest.mark.slow
def test_the_changed_part_comes_first_and_its_change_lies_in_the_interval(tmp_path: Path) -> None:
    first, inside = [], []
    for seed in range(10):
        part = list(CHANGES)[seed % 3]
        run, true = changed(tmp_path, part, seed)
        (test,) = twin([run]).tests
        best = test.findings[0]
        first.append(best.part == part and test.answer == "one part")
        inside.append(best.part == part and best.lower <= true <= best.upper)
    assert sum(first) >= 8
    assert sum(inside) >= 9


def test_a_leg_like_the_model_deviates_in_nothing(tmp_path: Path) -> None:
    report = twin([graded(tmp_path, {}, 3)])
    assert report.tests[0].answer == "nothing deviates"
    assert "No part deviates" in twin_text(report)


def test_what_looks_alike_is_named_together(tmp_path: Path) -> None:
    small = {"legform.knee.ligaments.PCL.stiffness": "144 kN/m"}
    (test,) = twin([graded(tmp_path, small, 4)]).tests
    named = {finding.part for finding in test.findings if finding.candidate}
    assert test.answer == "several parts would do"
    assert {"MCL", "PCL"} <= named
    assert all(part in said(test, language()) for part in named)


@pytest.mark.parametrize(
    ("overrides", "gauges"),
    [
        # Two parts; the larger change alone takes 95 % of the deviation away.
        (
            {
                "legform.knee.ligaments.MCL.stiffness": "53.4 kN/m",
                "legform.flesh.compression": "0.3776 MN/m²",
            },
            {},
        ),
        # What no part of the diagnosis stands for; a softer MCL, or the hinge, would do most of it.
        ({"legform.knee.parallel stiffness": "275 N·m/rad"}, {}),
        ({"legform.flesh.mass": "4.2 kg"}, {}),
        # One gauge of eleven.
        ({}, {"T2": 0.85}),
        ({}, {"F2": 1.1}),
    ],
    ids=["two parts", "knee covers", "heavy flesh", "gauge T2", "gauge F2"],
)
def test_what_no_single_part_does_is_not_put_down_to_one(
    overrides: dict[str, str], gauges: dict[str, float], tmp_path: Path
) -> None:
    (test,) = twin([graded(tmp_path, overrides, 11, gauges)]).tests
    assert test.answer == "no part explains it"


def test_against_an_earlier_test_only_what_changed_since_counts(tmp_path: Path) -> None:
    odd = {"legform.parts.tibia.bending stiffness": "160 N·m²"}
    path, form, value, true = CHANGES["MCL"]
    before = graded(tmp_path / "before", odd, 5)
    after = graded(tmp_path / "after", {**odd, path: form.format(value)}, 6)
    report = twin([after], against=before)
    best = report.tests[0].findings[0]
    assert best.part == "MCL"
    assert best.lower <= true <= best.upper
    page = twin_page(report)
    assert best.remedy in page
    assert report.against in page


def test_tests_of_two_legs_or_without_channels_are_refused(tmp_path: Path) -> None:
    certificate("North", 1, 250.0).write(tmp_path / "bare.json")
    with pytest.raises(DataError, match="carries no channels"):
        twin([tmp_path / "bare.json"])
