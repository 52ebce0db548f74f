"""The whole pendulum test, knee, flesh and stopper included, against a second implementation of it."""

from __future__ import annotations

import numpy as np
import pytest
from pendulum_oracle import Pendulum, solve

from certkit.definitions.library import load
from certkit.mechanics import simulate
from certkit.mechanics.channels import stations

UNTIL = 0.13


@pytest.mark.slow
def test_the_whole_pendulum_test_agrees_with_minimal_coordinates_within_0_1_per_cent():
    legform = load("legform", "flex-pli-gtr", overrides=["knee.condyles.friction=0"]).document
    procedure = load("procedure", "pendulum", overrides=["run.until=130 ms"]).document
    recording = simulate(procedure, legform).recording
    pendulum = Pendulum(legform, procedure)
    poses = solve(pendulum, np.arange(0, round(UNTIL / 1e-4) + 1) * 1e-4)
    for name, height in stations(legform.gauges).items():
        theirs = max(pendulum.moment(pose, height) for pose in poses)
        assert recording[name].values.max() == pytest.approx(theirs, rel=1e-3), name
    for name in ("MCL", "ACL", "PCL"):
        theirs = max(pendulum.elongation(pose, name) for pose in poses)
        assert recording[name].values.max() == pytest.approx(theirs, rel=1e-3), name


def test_at_first_contact_both_turn_about_the_hinge_with_the_speed_of_the_fall():
    legform = load("legform", "flex-pli-gtr").document
    procedure = load("procedure", "pendulum").document
    kinetic = simulate(procedure, legform).quality.energies["kinetic"][0]
    pendulum = Pendulum(legform, procedure)
    arms = np.concatenate([pendulum.centre, pendulum.centre + pendulum.flesh_height]) - pendulum.hinge
    masses = np.concatenate([pendulum.mass, pendulum.flesh_mass])
    about = masses @ arms**2 + pendulum.inertia.sum()
    assert kinetic == pytest.approx(0.5 * about * pendulum.rate**2, rel=1e-9)
