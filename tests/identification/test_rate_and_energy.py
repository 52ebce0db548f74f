"""Whether a law says that force follows the rate, and what energy comes back, in the run and by the law."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from certkit.definitions.extraction_case import Case
from certkit.definitions.loading.library import load
from certkit.identification import ExtractionResult
from certkit.identification.five_steps import extract
from certkit.identification.path_energy import path_energy

CASES = Path(__file__).parents[2] / "examples/extract"


@cache
def bumper(name: str, unloading: str = "force") -> ExtractionResult:
    changes = {"settings.unloading": unloading}
    folder = CASES / f"bumper-{name}"
    return extract(load("case", folder / "case.yaml", overrides=changes).document, folder)


def test_stress_above_the_materials_own_curve_is_told_with_a_figure_and_the_rates() -> None:
    said = [w for w in bumper("rate-dependent-foam").warnings if "stiffens with the rate" in w]
    assert len(said) == 1
    assert "fascia – beam: its stress lies 38 % above the material's own curve, at strain rates of" in said[0]
    assert "12 to 113 /s" in said[0]


@pytest.mark.parametrize("name", ["reference", "compliant-beam", "local-crush"])
def test_a_foam_without_rate_is_not_remarked(name: str) -> None:
    result = bumper(name)
    assert not any("the rate" in said for said in (*result.warnings, *result.notes))


TIME = np.arange(0.0, 0.100, 1e-4)
BALL, STIFFNESS, SPEED = 10.0, 1e5, 8.0


def ringing(folder: Path, damping: float) -> ExtractionResult:
    """Hang a ball on a wall by a spring and a damper, both ways, and let it swing at its own frequency."""
    decay = damping / (2 * BALL)
    swing = np.sqrt(STIFFNESS / BALL - decay**2)
    x = SPEED / swing * np.exp(-decay * TIME) * np.sin(swing * TIME)
    v = SPEED * np.exp(-decay * TIME) * (np.cos(swing * TIME) - decay / swing * np.sin(swing * TIME))
    rows = np.stack([1e3 * TIME, BALL * v, 1e3 * x, 0 * TIME, 0 * TIME], axis=1)
    head = "time_ms,ball_Ns,ball_mm,wall_Ns,wall_mm"
    np.savetxt(folder / "run.csv", rows, fmt="%.9g", delimiter=",", header=head, comments="")
    parts = {
        n: {"mass": f"{BALL} kg", "momentum": f"{n}_Ns", "displacement": f"{n}_mm"} for n in ("ball", "wall")
    }
    return extract(
        Case.model_validate(
            {
                "case": "ringing",
                "title": "A ball on a spring",
                "origin": {"source": "test", "confidence": "verified"},
                "histories": {"format": "tidy csv", "files": ["run.csv"], "parts": parts},
                "groups": {n: {"kind": "engine room", "parts": [n]} for n in parts},
                "paths": [
                    {"between": ["ball", "wall"], "tension": True},
                    {"between": ["wall", "ground"], "law": False},
                ],
            }
        ),
        folder,
    )


def test_a_damper_is_found_and_told(tmp_path: Path) -> None:
    result = ringing(tmp_path, 120.0)
    said = [
        note for note in result.notes if "ball – wall: its residual" in note and "follows the rate" in note
    ]
    assert len(said) == 1
    assert result.paths[0].law is not None
    assert result.paths[0].law.damping == pytest.approx(120.0, rel=0.1)


def test_a_spring_without_a_damper_says_nothing_of_the_rate(tmp_path: Path) -> None:
    result = ringing(tmp_path, 0.0)
    assert not any("the rate" in said for said in (*result.warnings, *result.notes))


def test_energy_is_the_integral_of_force_over_shortening() -> None:
    x = np.concatenate([np.linspace(0.0, 0.1, 101), np.linspace(0.1, 0.05, 51)[1:]])
    force = np.concatenate([np.linspace(0.0, 1000.0, 101), np.linspace(1000.0, 0.0, 51)[1:]])
    found = path_energy(x, force)
    assert found.put_in == pytest.approx(50.0)
    assert found.absorbed == pytest.approx(25.0)


def test_a_law_returns_nearly_what_the_run_returned_and_both_are_told() -> None:
    energy = next(p for p in bumper("reference").paths if p.name == "fascia – beam").energy
    assert energy is not None
    assert energy.law_absorbed is not None
    assert energy.put_in == pytest.approx(355.4, rel=0.01)
    assert energy.law_absorbed == pytest.approx(energy.absorbed, abs=0.05 * energy.put_in)


def test_unloading_by_energy_returns_what_the_run_returned_at_a_little_more_misfit() -> None:
    held, free = (
        next(p for p in bumper("reference", unloading).paths if p.name == "fascia – beam")
        for unloading in ("energy", "force")
    )
    assert held.energy is not None
    assert held.law is not None
    assert free.law is not None
    assert held.energy.law_absorbed == pytest.approx(held.energy.absorbed, abs=0.004 * held.energy.put_in)
    assert held.law.misfit_percent < free.law.misfit_percent + 1.0
