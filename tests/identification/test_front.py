"""The finite-element front: fourteen groups, every load path, and the leg that hits what was extracted."""

from __future__ import annotations

import gzip
import shutil
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import butter, filtfilt

from certkit.definitions.loading.library import load
from certkit.errors import DataError
from certkit.exchange.fe.numeric_table import read_table
from certkit.identification import ExtractionResult, vehicle_text
from certkit.identification.five_steps import extract
from certkit.mechanics import Simulation, simulate

FRONT = Path(__file__).parents[2] / "examples/extract/front"
FLIGHT = 1.44e-3  # s from the finite-element run's start to first contact: 16 mm at 11.1 m/s


@pytest.fixture(scope="module")
def result() -> ExtractionResult:
    return extract(load("case", FRONT / "case.yaml").document, FRONT)


@pytest.fixture(scope="module")
def hit(result: ExtractionResult, tmp_path_factory: pytest.TempPathFactory) -> Simulation:
    path = tmp_path_factory.mktemp("front") / "vehicle.yaml"
    path.write_text(vehicle_text(result))
    sheet = load("procedure", "vehicle-fe-front").document
    legform = load("legform", "fe-front-leg").document
    return simulate(sheet, legform, vehicle=load("vehicle", path).document)


def cfc180(values: np.ndarray, interval: float) -> np.ndarray:
    b, a = butter(2, 300 * 2 * interval)
    return filtfilt(b, a, values)


def first_peak(values: np.ndarray, interval: float) -> tuple[float, float]:
    """Return the largest filtered value up to 22 ms after the run's start, and its time after contact."""
    smooth = cfc180(values, interval)[: round((0.022 + 0.003 - FLIGHT) / interval)]
    k = int(np.argmax(smooth))
    return float(smooth[k]), k * interval


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


@pytest.mark.parametrize("channel", ["T1", "T2", "T3", "T4"])
def test_first_tibia_peaks_are_those_of_the_finite_element_run(hit: Simulation, channel: str) -> None:
    fe = read_table(FRONT / "leg_channels.csv.gz").columns
    interval = float(np.median(np.diff(fe["time_ms"]))) * 1e-3
    wanted, when = first_peak(fe[f"{channel}_Nm"], interval)
    value, time = first_peak(hit.recording[channel].values, hit.recording.interval)
    assert value == pytest.approx(wanted, rel=0.15)
    assert time == pytest.approx(when - FLIGHT, abs=3e-3)


def test_contact_force_and_its_impulse_are_those_of_the_finite_element_run(hit: Simulation) -> None:
    fe = read_table(FRONT / "contact_forces.csv.gz").columns
    interval = float(np.median(np.diff(fe["time_ms"]))) * 1e-3
    force = hit.recording["contact force"].values
    peak = cfc180(force, hit.recording.interval).max()
    assert peak == pytest.approx(cfc180(fe["leg_vehicle__Fx_N"], interval).max(), rel=0.15)
    assert force.sum() * hit.recording.interval == pytest.approx(fe["leg_vehicle__Jx_Ns"].max(), rel=0.05)


def test_another_front_in_the_same_layout_is_extracted_by_the_same_case(tmp_path: Path) -> None:
    for name in ("groups_table.csv", "params.json"):
        shutil.copy(FRONT / name, tmp_path)
    for name in ("vehicle_groups", "contact_forces", "ground_forces", "leg_channels"):
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
