"""The end of the assessment interval is a knife edge: what lies just outside of it is remarked upon."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from tests.grading.test_plausibility_gate import Floats, damaged, graded, intact

if TYPE_CHECKING:
    from certkit.documents.result import Result

AFTER = 0.0015
"""Seconds after the interval's end at which a second peak of the ACL is put."""


def with_second_peak(height: float, after: float = AFTER) -> Result:
    """Grade the intact test with a peak of the ACL, which ends no interval, of a height in mm."""
    interval = graded(intact()).interval
    assert interval is not None

    def change(time: Floats, values: Floats) -> Floats:
        at = interval[1] + after
        own = float(np.interp(at, time, values))
        return values + (1e-3 * height - own) * np.exp(-0.5 * ((time - at) / 9e-4) ** 2)

    return graded(damaged("ACL", change))


def codes(result: Result) -> set[str]:
    return {reason.code for reason in result.coded_remarks} & {"interval-end-decides", "peak-near-interval"}


def test_an_intact_test_is_not_remarked_upon():
    assert codes(graded(intact())) == set()


@pytest.mark.parametrize(("height", "code"), [(7.5, "peak-near-interval"), (14.5, "interval-end-decides")])
def test_a_peak_just_outside_is_told_and_so_is_an_end_that_decides(height: float, code: str):
    result = with_second_peak(height)
    assert result.verdict == "pass", [c.reason for c in result.criteria]
    assert codes(result) == {code}


def test_a_peak_long_after_the_interval_is_not():
    assert codes(with_second_peak(9.0, after=0.012)) == set()
