"""The pendulum test in Exudyn, and the speed it arrives with."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from support.pendulum_oracle import Pendulum

from certkit.definitions.loading.library import load
from certkit.mechanics import simulate

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform

UNTIL = 0.13


@pytest.fixture(scope="module")
def legform() -> Legform:
    """Return the shipped leg without friction in the knee."""
    return load("legform", "flex-pli-gtr", overrides={"knee.condyles.friction": "0"}).document


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # Exudyn renames its settings now and then
def test_the_whole_pendulum_test_agrees_with_exudyn_within_half_a_per_cent(legform: Legform):
    pytest.importorskip("exudyn")
    from support.pendulum_in_exudyn import solve_in_exudyn  # noqa: PLC0415  # skipped where Exudyn is not installed

    # A bar that the upright leg just touches: knee 108 mm deep under 30 mm of flesh, tibia 90 mm deep.
    upright = {"rig.stopper.tibia face to edge": "39 mm", "rig.stopper.cover": "0 mm"}
    procedure = load("procedure", "pendulum", overrides={"run.until": "130 ms", **upright}).document
    ours = simulate(procedure, legform).recording
    pendulum = Pendulum(legform, procedure)
    theirs = pendulum.channels(solve_in_exudyn(pendulum, UNTIL, step=1e-4, sample=1e-4))
    for name, values in theirs.items():
        assert float(ours[name].values.max()) == pytest.approx(float(values.max()), rel=5e-3), name


def test_at_first_contact_both_turn_about_the_hinge_with_the_speed_of_the_fall(legform: Legform):
    procedure = load("procedure", "pendulum", overrides={"run.until": "1 ms"}).document
    kinetic = simulate(procedure, legform).quality.energies["kinetic"][0]
    pendulum = Pendulum(legform, procedure)
    arms = np.concatenate([pendulum.centre, pendulum.centre + pendulum.flesh_height]) - pendulum.hinge
    masses = np.concatenate([pendulum.mass, pendulum.flesh_mass])
    about = masses @ arms**2 + pendulum.inertia.sum()
    # The leg still falls for part of a step until it presses.
    assert kinetic == pytest.approx(0.5 * about * pendulum.rate**2, rel=2e-4)
