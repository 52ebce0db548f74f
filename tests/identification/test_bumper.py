"""The seed's simple bumper: closure of impulse, force, stress–strain, from every format."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from certkit.definitions.loading.library import load
from certkit.identification import ExtractionResult, vehicle_text
from certkit.identification.five_steps import extract

CASES = Path(__file__).parents[2] / "examples/extract"
FORMATS = ["case.yaml", "case-converted.yaml", "case-tidy.yaml"]
if importlib.util.find_spec("lasso") is not None:
    FORMATS.append("case-binout.yaml")


def run(folder: str, case: str = "case.yaml") -> ExtractionResult:
    document = load("case", CASES / folder / case).document
    return extract(document, CASES / folder)


@pytest.fixture(scope="module")
def reference() -> ExtractionResult:
    return run("bumper-reference")


@pytest.mark.parametrize("case", FORMATS)
def test_the_reference_bumper_meets_its_targets_from_every_format(case: str) -> None:
    result = run("bumper-reference", case)
    path = next(p for p in result.paths if p.name == "fascia – beam")
    assert path.closures[0].percent <= 0.1
    assert path.force_error_percent is not None
    assert path.force_error_percent <= 2.0
    assert result.material is not None
    assert result.material.rms_percent is not None
    assert result.material.rms_percent <= 3.0


def test_a_compliant_beam_still_gives_the_foam_within_six_per_cent() -> None:
    material = run("bumper-compliant-beam").material
    assert material is not None
    assert material.rms_percent is not None
    assert material.rms_percent <= 6.0


def test_a_foam_that_stiffens_with_rate_lies_above_its_static_curve() -> None:
    material = run("bumper-rate-dependent-foam").material
    assert material is not None
    assert material.mean_percent is not None
    assert 30 <= material.mean_percent <= 50


def test_local_crush_gets_no_stress_strain_curve_and_says_why() -> None:
    result = run("bumper-local-crush")
    assert result.material is None
    assert any("not crushed uniformly" in warning for warning in result.warnings)


def test_leaving_the_fascia_out_of_what_lies_upstream_costs_several_per_cent(
    reference: ExtractionResult,
) -> None:
    impactor = np.array(next(g for g in reference.groups if g.name == "impactor").momentum)
    force = np.array(next(p for p in reference.paths if p.name == "fascia – beam").recorded_force)
    without = -np.gradient(impactor, reference.interval)
    assert np.sqrt(np.mean((without - force) ** 2)) > 0.03 * force.max()


def test_a_contact_that_recorded_nothing_does_not_close(tmp_path: Path) -> None:
    folder = CASES / "bumper-reference"
    for name in ("case-tidy.yaml", "foam-curve.csv"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    head, *rows = (folder / "histories.csv").read_text("utf-8").splitlines()
    place = head.split(",").index("J_fascia_foam_Ns")
    dead = [",".join("0" if n == place else cell for n, cell in enumerate(row.split(","))) for row in rows]
    (tmp_path / "histories.csv").write_text("\n".join([head, *dead]), "utf-8")
    result = extract(load("case", tmp_path / "case-tidy.yaml").document, tmp_path)
    path = next(p for p in result.paths if p.name == "fascia – beam")
    assert path.closures[0].percent == pytest.approx(100)
    assert any("impulse does not close" in warning for warning in result.warnings)
    assert not result.closed


def test_a_result_survives_its_json(reference: ExtractionResult) -> None:
    text = reference.to_json()
    assert ExtractionResult.from_json(text).to_json() == text


def test_the_same_case_gives_the_same_bytes(reference: ExtractionResult) -> None:
    again = run("bumper-reference")
    assert again.to_json() == reference.to_json()
    assert vehicle_text(again) == vehicle_text(reference)


def test_the_vehicle_document_can_be_read_and_says_that_it_is_derived(
    reference: ExtractionResult, tmp_path: Path
) -> None:
    path = tmp_path / "vehicle.yaml"
    path.write_text(vehicle_text(reference))
    vehicle = load("vehicle", path).document
    point = next(iter(vehicle.springs.values())).loading[1]
    assert point[1].confidence == "derived"
    assert "SHA-256" in point[1].source


@pytest.mark.parametrize(
    "name", ["bumper-reference", "bumper-compliant-beam", "bumper-rate-dependent-foam", "bumper-local-crush"]
)
def test_a_fascia_that_is_joined_to_no_other_has_springs_alone(name: str) -> None:
    path = next(path for path in run(name).paths if path.name == "fascia – beam")
    assert path.law is not None
    assert path.sheet is None
