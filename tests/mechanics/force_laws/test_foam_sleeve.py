"""What a sleeve of foam under a skin does beside a joint that bends and comes back."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.mechanics.force_laws import LAWS
from certkit.mechanics.force_laws.foam_sleeve import FoamSleeve
from certkit.mechanics.solver.time_loop import Plan, Trajectory, run_world
from certkit.mechanics.solver.world import Assembly

STEP = 1e-5
FOAM = 100.0
"""k_f, N·m/rad."""


def swung(
    rate: float, *, hysteresis: float = 0.35, elastic: float = 2.14 * FOAM, skin: float = 0.0
) -> Trajectory:
    """Bend a light body against a heavy one at a rate (rad/s) until it is back and a little further."""
    assembly = Assembly()
    upper = assembly.add_body("held", 1e6, 1e6, (0.0, 0.0, 0.0))
    lower = assembly.add_body("swung", 1.0, 0.01, (0.0, 0.0, 0.0), speed=(0.0, 0.0, rate))
    assembly.add(
        FoamSleeve(upper=upper, lower=lower, skin=skin, foam=FOAM, elastic=elastic, hysteresis=hysteresis)
    )
    return run_world(assembly.finish(), Plan(STEP, 0.06, 0.0), tracked=[lower])


def given_back(run: Trajectory) -> float:
    """Return the share of the first swing's energy that is left when the joint is straight again."""
    angle, kinetic = run.tracks[:, 0, 2], run.kinetic
    back = int(np.argmax(np.sign(angle[100:]) != np.sign(angle[50]))) + 100
    return float(kinetic[back] / kinetic[0])


@pytest.mark.parametrize("rate", [0.5, 5.0, -5.0])
def test_foam_gives_back_what_is_under_its_slope_and_its_unloading_line_at_any_speed(rate: float) -> None:
    slope, hysteresis = 2.14, 0.35
    met = (slope - 1) / (slope - hysteresis)
    share = (1 - (hysteresis * met) ** 2) / slope + hysteresis * met**2
    assert given_back(swung(rate)) == pytest.approx(share, rel=2e-3)


def test_a_skin_gives_back_all_it_took() -> None:
    bare, skinned = given_back(swung(5.0)), given_back(swung(5.0, skin=FOAM))
    assert skinned == pytest.approx(0.5 * (1 + bare), rel=2e-3)


def test_foam_without_hysteresis_is_a_spring() -> None:
    run = swung(5.0, hysteresis=1.0)
    assert given_back(run) == pytest.approx(1.0, rel=1e-3)
    assert run.tracks[:, 0, 2].max() == pytest.approx(5.0 * np.sqrt(0.01 / FOAM), rel=1e-3)


def test_what_is_neither_kinetic_nor_stored_was_lost() -> None:
    run = swung(5.0, skin=30.0)
    row = LAWS.index(FoamSleeve)
    total = run.kinetic + run.stored[:, row] + run.dissipated[:, row]
    assert np.abs(total - total[0]).max() < 1e-4 * total[0]
    assert np.all(np.diff(run.dissipated[:, row]) > -1e-6 * total[0])
