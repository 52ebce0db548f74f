"""Fronts of other classes, whose laws are known, extracted from what a run tells of them: they come back."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from certkit import extract
from tests.support.made_up_fronts import made_up_run

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.self_check import SelfCheck

LIFTED = {"H1": ("1195 mm", "1250 mm"), "H2": ("1250 mm", "1350 mm")}
"""A hood 0.4 m higher than the leg reaches."""

FRONTS = {
    "suv": {"vehicle": "generic-suv", "speed": 10.0, "end": 0.05},
    "sports car": {"vehicle": "generic-sports-car", "speed": 12.0, "end": 0.075},
    "hood out of reach": {
        "vehicle": "generic-suv",
        "speed": 11.1,
        "end": 0.075,
        "changes": {
            f"groups.{name}.{key}": height
            for name, heights in LIFTED.items()
            for key, height in zip(("low", "high"), heights, strict=True)
        },
    },
}


@pytest.fixture(scope="module", params=FRONTS)
def result(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> ExtractionResult:
    return extract(made_up_run(tmp_path_factory.mktemp("run"), **FRONTS[request.param]))


def check_of(result: ExtractionResult, key: str) -> SelfCheck:
    return next(check for check in result.checks if check.id == key)


def test_its_springs_move_the_front_as_in_the_run(result: ExtractionResult) -> None:
    alone = check_of(result, "front alone")
    assert alone.worst_percent is not None
    assert alone.worst_percent < 3
    assert result.closed


def test_leg_and_front_together_are_the_run(result: ExtractionResult) -> None:
    """Within what finite elements of 20 mm tell of where on a face the leg presses."""
    coupled = check_of(result, "coupled")
    assert coupled.mean_percent is not None
    assert coupled.mean_percent < 5
    assert coupled.force_percent == pytest.approx(0, abs=8)
    assert coupled.impulse_percent == pytest.approx(0, abs=3)
    assert coupled.wrong_group_percent == pytest.approx(0, abs=5)
    assert {c.name: c.rms_percent for c in coupled.channels if c.rms_percent > 12} == {}
    assert {c.name: c.error_percent for c in coupled.channels if abs(c.error_percent) > 15} == {}


def test_a_hood_that_the_leg_does_not_reach_is_left_out(result: ExtractionResult) -> None:
    touched = {p.target: max(p.impulse) for p in result.paths if p.source == "leg"}
    moved = {group.name for group in check_of(result, "coupled").groups}
    assert ("H1" in moved) == (touched["H1"] > 0)
