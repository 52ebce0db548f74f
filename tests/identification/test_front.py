"""The finite-element front: fourteen groups, every load path, and the leg that hits what was extracted."""

from __future__ import annotations

import gzip
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from scipy.signal import butter, filtfilt

from certkit.definitions.loading.library import load
from certkit.errors import DataError
from certkit.exchange.fe.numeric_table import read_table
from certkit.identification import ExtractionResult, vehicle_text
from certkit.identification.five_steps import extract
from certkit.mechanics import Simulation, simulate
from certkit.mechanics.fixtures.recorded_force import RecordedForce
from certkit.mechanics.recorded_drive import drive_front

if TYPE_CHECKING:
    from collections.abc import Mapping

    from certkit.definitions.vehicle import Vehicle

FRONT = Path(__file__).parents[2] / "examples/extract/front1"
START = 0.96e-3  # s: first contact of the finite-element run
UNTIL = 45e-3  # s of that run


@pytest.fixture(scope="module")
def result() -> ExtractionResult:
    return extract(load("case", FRONT / "case.yaml").document, FRONT)


@pytest.fixture(scope="module")
def vehicle(result: ExtractionResult, tmp_path_factory: pytest.TempPathFactory) -> Vehicle:
    path = tmp_path_factory.mktemp("front") / "vehicle.yaml"
    path.write_text(vehicle_text(result))
    return load("vehicle", path).document


@pytest.fixture(scope="module")
def hit(vehicle: Vehicle) -> Simulation:
    sheet = load("procedure", "vehicle-fe-front").document
    return simulate(sheet, load("legform", sheet.specimen.legform).document, vehicle=vehicle)


def filtered(values: np.ndarray, interval: float) -> np.ndarray:
    b, a = butter(2, 300 * 2 * interval)
    return filtfilt(b, a, values)


def recorded(file: str, column: str, times: np.ndarray) -> np.ndarray:
    table = read_table(FRONT / file).columns
    return np.interp(times + START, 1e-3 * table["time_ms"], table[column])


def face_errors(
    result: ExtractionResult, time: np.ndarray, moved: Mapping[str, np.ndarray]
) -> dict[str, float]:
    """Return the rms error of each face's movement, in per cent of the largest of the run."""
    times = np.array(result.times)
    errors = {}
    for group in result.groups:
        if group.position is None or group.name == "H2":  # the hood's rear moves by 2 mm
            continue
        wanted = np.array(group.displacement)[times <= UNTIL]
        got = np.interp(times[times <= UNTIL], time, moved[group.name])
        errors[group.name] = 100 * np.sqrt(np.mean((got - wanted) ** 2)) / np.abs(wanted).max()
    return errors


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


def test_the_front_alone_moves_as_in_the_run_under_the_forces_of_the_run(
    result: ExtractionResult, vehicle: Vehicle
) -> None:
    times = np.array(result.times)
    forces = [
        RecordedForce(path.target, times, np.array(path.force), np.zeros_like(times))
        for path in result.paths
        if path.source == "leg"
    ]
    driven = drive_front(vehicle, forces, UNTIL)
    errors = face_errors(result, driven.time, driven.displacement)
    assert np.mean(list(errors.values())) < 12
    assert max(errors.values()) < 25


def test_the_front_hit_by_the_leg_moves_as_in_the_run(result: ExtractionResult, hit: Simulation) -> None:
    assert hit.front is not None
    histories = hit.front.displacement
    time = START + histories.start + histories.interval * np.arange(histories.count)
    moved = {name: 1e-3 * np.array(series.values) for name, series in histories.series.items()}
    errors = face_errors(result, time, moved)
    assert np.mean(list(errors.values())) < 12
    assert max(errors.values()) < 30


CHANNELS = ["T1", "T2", "T3", "T4", "F1", "F2", "F3", "MCL", "ACL", "PCL"]


@pytest.mark.parametrize("channel", CHANNELS)
def test_bending_and_ligaments_are_those_of_the_run_though_nothing_was_fitted_to_them(
    hit: Simulation, channel: str
) -> None:
    interval, times = hit.recording.interval, hit.recording.time
    ligament = channel.endswith("CL")
    column = f"{channel}_elong_mm" if ligament else f"{channel}_Nm"
    wanted = filtered(recorded("leg_channels.csv.gz", column, times), interval) * (1e-3 if ligament else 1)
    value = filtered(hit.recording[channel].values, interval)
    assert value.max() == pytest.approx(wanted.max(), rel=0.12)
    assert np.sqrt(np.mean((value - wanted) ** 2)) < 0.1 * wanted.max()


def test_contact_force_and_its_impulse_are_those_of_the_run(hit: Simulation) -> None:
    interval, times = hit.recording.interval, hit.recording.time
    force = hit.recording["contact force"].values
    wanted = filtered(recorded("contact_forces.csv.gz", "leg_vehicle__Fx_N", times), interval)
    impulse = recorded("contact_forces.csv.gz", "leg_vehicle__Jx_Ns", times[-1:])[0]
    assert filtered(force, interval).max() == pytest.approx(wanted.max(), rel=0.1)
    assert force.sum() * interval == pytest.approx(impulse, rel=0.04)


def test_each_group_takes_its_own_impulse(result: ExtractionResult, hit: Simulation) -> None:
    assert hit.front is not None
    histories, end = hit.front.contact, hit.recording.time[-1] + START
    paths = {path.target: path for path in result.paths if path.source == "leg"}
    wanted = {name: np.interp(end, result.times, path.impulse) for name, path in paths.items()}
    got = {name: sum(series.values) * histories.interval for name, series in histories.series.items()}
    wrong = sum(abs(got.get(name, 0.0) - value) for name, value in wanted.items()) / 2
    assert wrong < 0.08 * sum(wanted.values())


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
