"""A run that is told otherwise is the same run: its front comes out the same, and meets the same leg."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from certkit import extract
from tests.support.changed_fronts import FRONT, copied, later, raised

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult

WITHIN = 1.0
"""Per cent of a peak: a quarter of what the reference's own scatter is worth."""


@pytest.fixture(scope="module")
def told() -> ExtractionResult:
    return extract(FRONT / "case.yaml")


@pytest.fixture(scope="module")
def otherwise(tmp_path_factory: pytest.TempPathFactory) -> ExtractionResult:
    """Return the front and its leg 100 mm higher, on a clock that shows 10 ms at the start."""
    folder = tmp_path_factory.mktemp("front")
    case = copied(folder)
    raised(folder, 100.0)
    later(folder, 10.0)
    return extract(case)


def test_height_and_clock_change_nothing_of_front_and_leg(
    told: ExtractionResult, otherwise: ExtractionResult
) -> None:
    for one, other in zip(told.checks, otherwise.checks, strict=True):
        assert other.until == pytest.approx(one.until + 0.010, abs=1e-6)
        channels = {c.name: c for c in one.channels}
        for channel in other.channels:
            same = channels[channel.name]
            assert channel.peak == pytest.approx(same.peak, rel=WITHIN / 100)
            assert channel.rms_percent == pytest.approx(same.rms_percent, abs=WITHIN)
        moved = {g.name: g.peak for g in one.groups}
        for group in other.groups:
            # Half a millimetre is what the last digits of another C library move a group that hardly moves.
            assert group.peak == pytest.approx(moved[group.name], rel=0.03, abs=5e-4)


def test_the_leg_alone_runs_on_the_clock_of_its_run(told: ExtractionResult) -> None:
    """A contact that is found too early, in smoothed forces, would make every channel late."""
    alone = next(check for check in told.checks if check.id == "leg alone")
    later_by = sorted(c.time - c.run_time for c in alone.channels)
    assert abs(later_by[len(later_by) // 2]) < 5e-4


def test_how_the_leg_flew_is_said(otherwise: ExtractionResult) -> None:
    assert "self-checks throw the leg as the run did: 11.1 m/s, 175 mm above the ground" in otherwise.notes


def test_a_leg_of_another_weight_is_warned_of(tmp_path: Path) -> None:
    case = copied(tmp_path)
    case.write_text(case.read_text().replace("13.314 kg", "13.0 kg"))
    warned = extract(case).warnings
    assert any("the run's impactor weighs 13 kg, the leg `fe-leg`" in warning for warning in warned)


def test_a_coupled_run_beyond_its_limits_cannot_be_trusted(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same gate as of `certkit run`: here the flesh is pressed deeper than is allowed for once."""
    monkeypatch.setattr("certkit.grading.quality_gate.FLESH_DEPTH_LIMIT", 10.0)
    result = extract(FRONT / "case.yaml")
    coupled = next(check for check in result.checks if check.id == "coupled")
    assert coupled.within is False
    said = "Leg and front together: The run cannot be trusted: flesh depth over its thickness"
    assert any(warning.startswith(said) for warning in result.warnings)
