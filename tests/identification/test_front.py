"""The finite-element front: fourteen groups, every load path, and the leg that hits what was extracted."""

from __future__ import annotations

import gzip
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.bench.extract_vehicle import extract as extract_with_checks
from certkit.definitions.loading.library import load
from certkit.errors import DataError
from certkit.identification import ExtractionResult
from certkit.identification.five_steps import extract

if TYPE_CHECKING:
    from certkit.documents.self_check import SelfCheck

FRONT = Path(__file__).parents[2] / "examples/extract/front1"
FACES = {"F1", "F2", "F3", "F4", "F5", "F6", "F7", "H1"}


@pytest.fixture(scope="module")
def result() -> ExtractionResult:
    return extract_with_checks(FRONT / "case.yaml")


@pytest.fixture(scope="module")
def checks(result: ExtractionResult) -> dict[str, SelfCheck]:
    return {check.id: check for check in result.checks}


def test_there_are_seven_fascia_two_hood_and_five_engine_room_groups(result: ExtractionResult) -> None:
    kinds = [g.kind for g in result.groups]
    assert [kinds.count(k) for k in ("fascia", "hood", "engine room")] == [7, 2, 5]


def test_impulse_closes_on_every_load_path(result: ExtractionResult) -> None:
    assert all(path.closures for path in result.paths)
    assert max(c.percent for path in result.paths for c in path.closures) < 0.5


def test_the_flange_carries_what_the_crossmember_passes_on(result: ExtractionResult) -> None:
    paths = {p.name: np.array(p.impulse) for p in result.paths}
    crossmember = np.array(next(g for g in result.groups if g.name == "E4").momentum)
    passed = paths["E4 – ground"] + crossmember - paths["H1 – E4"]
    assert np.abs(paths["F7 – E4"] - passed).max() < 0.005 * paths["E4 – ground"].max()


def test_ground_springs_come_back_with_the_stiffness_of_the_model(result: ExtractionResult) -> None:
    laws = {p.name: p.law for p in result.paths}
    for name, stiffness, damping in (("E3 – ground", 1.0e6, 150.0), ("E4 – ground", 1.0e6, 80.0)):
        law = laws[name]
        assert law is not None
        assert np.interp(2e-3, law.shortening, law.force) == pytest.approx(2e-3 * stiffness, rel=0.05)
        assert law.damping == pytest.approx(damping, rel=0.25)


def test_a_fascia_that_slides_along_a_stiffener_has_no_spring_but_a_path(result: ExtractionResult) -> None:
    paths = {p.name: p for p in result.paths}
    for name in ("F1 – E1", "F2 – E1", "F5 – E2"):
        sheet = paths[name].sheet
        assert sheet is not None
        assert not sheet.tension
        assert sheet.misfit_percent < 5
    assert paths["F4 – E2"].law is not None  # the foam is crushed


def test_no_law_pushes_harder_than_what_it_was_read_from(result: ExtractionResult) -> None:
    for path in result.paths:
        if path.law is not None:
            seen = np.array(path.law.shortening) <= max(path.shortening)
            largest = max(map(abs, path.force))
            assert max(np.array(path.law.force)[seen]) <= 1.01 * largest


def test_springs_with_dampers_are_told_and_those_without_are_not(result: ExtractionResult) -> None:
    said = {note.partition(":")[0]: note for note in result.notes if "follows the rate" in note}
    assert said.keys() == {"E3 – ground", "E4 – ground"}
    assert "a damper of 133 N·s/m takes it up" in said["E3 – ground"]  # 150 in the model


@pytest.mark.parametrize("check", ["front alone", "coupled"])
def test_the_front_moves_as_in_the_run(checks: dict[str, SelfCheck], check: str) -> None:
    mean, worst = checks[check].mean_percent, checks[check].worst_percent
    assert mean is not None
    assert worst is not None
    assert mean < 12
    assert worst < 30
    assert worst == max(g.rms_percent for g in checks[check].groups if g.name in FACES)


def test_contact_force_impulse_and_rebound_are_those_of_the_run(checks: dict[str, SelfCheck]) -> None:
    coupled = checks["coupled"]
    assert coupled.force_percent == pytest.approx(0, abs=10)
    assert coupled.impulse_percent == pytest.approx(0, abs=4)
    assert coupled.rebound_percent == pytest.approx(0, abs=6)


def test_the_stiffener_loads_the_two_faces_before_it_as_in_the_run(checks: dict[str, SelfCheck]) -> None:
    groups = {g.name: g for g in checks["coupled"].groups}
    for name in ("F1", "F2"):
        assert groups[name].impulse == pytest.approx(groups[name].run_impulse, rel=0.15)


def test_the_contact_alone_is_held_to_the_run_where_leg_and_front_move_as_in_it(
    checks: dict[str, SelfCheck],
) -> None:
    contact = checks["contact alone"]
    assert {g.name for g in contact.groups if g.force_rms_percent is not None} == FACES
    assert max(g.rms_percent for g in contact.groups) < 0.1
    assert contact.wrong_group_percent is not None
    assert contact.wrong_group_percent < 12
    assert contact.force_percent == pytest.approx(0, abs=10)
    assert contact.impulse_percent == pytest.approx(0, abs=8)


def test_each_group_takes_its_own_impulse(checks: dict[str, SelfCheck]) -> None:
    assert checks["coupled"].wrong_group_percent is not None
    assert checks["coupled"].wrong_group_percent < 5


@pytest.mark.parametrize("channel", ["T1", "T2", "T3", "T4", "F1", "F2", "F3", "MCL", "ACL", "PCL"])
def test_the_front_bends_its_leg_as_in_the_run_though_nothing_was_fitted_to_it(
    checks: dict[str, SelfCheck], channel: str
) -> None:
    alone, coupled = (
        next(c for c in checks[check].channels if c.name == channel) for check in ("leg alone", "coupled")
    )
    assert coupled.peak == pytest.approx(coupled.run_peak, rel=0.12)
    # When a flat top has its largest value says nothing: it is there as soon as all but a hundredth is.
    values = np.array(coupled.values)
    reached = values[round((coupled.run_time - coupled.start) / coupled.interval)]
    assert reached > 0.99 * coupled.peak or coupled.time == pytest.approx(coupled.run_time, abs=2.5e-3)
    assert coupled.rms_percent < 10
    assert alone.peak == pytest.approx(coupled.run_peak, rel=0.15)
    assert alone.rms_percent < 10


def test_an_extraction_says_that_it_closes_and_can_be_trusted(result: ExtractionResult) -> None:
    assert result.closed
    assert all(check.within is not False for check in result.checks)


def test_another_front_in_the_same_layout_is_extracted_by_the_same_case(tmp_path: Path) -> None:
    for name in ("groups_table.csv", "params.json"):
        shutil.copy(FRONT / name, tmp_path)
    for name in ("vehicle_groups", "contact_forces", "ground_forces", "leg_channels", "animation_1ms"):
        text = gzip.decompress((FRONT / f"{name}.csv.gz").read_bytes()).decode()
        (tmp_path / f"{name}.csv").write_text(text.replace("F4_bumper_centre", "F4_other_name"))
    table = (tmp_path / "groups_table.csv").read_text()
    (tmp_path / "groups_table.csv").write_text(table.replace("F4_bumper_centre", "F4_other_name"))
    other = extract(load("case", FRONT / "case.yaml").document, tmp_path)
    assert "F4_other_name" in next(g for g in other.groups if g.name == "F4").parts


def test_a_load_that_nobody_can_divide_is_refused_not_guessed(tmp_path: Path) -> None:
    text = (
        (FRONT / "case.yaml")
        .read_text()
        .replace(', contact: "foam_F4_*"', "")
        .replace(', contact: "foam_F5_*"', "")
    )
    (tmp_path / "case.yaml").write_text(text)
    with pytest.raises(DataError, match=r"cannot tell how the load divides between .*F4 – E2"):
        extract(load("case", tmp_path / "case.yaml").document, FRONT)


def test_a_reversed_path_shows_in_the_closure(tmp_path: Path) -> None:
    text = (FRONT / "case.yaml").read_text().replace("between: [H1, E4]", "between: [E4, H1]")
    (tmp_path / "case.yaml").write_text(text)
    warned = extract(load("case", tmp_path / "case.yaml").document, FRONT).warnings
    assert any("impulse does not close" in warning for warning in warned)
