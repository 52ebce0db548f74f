"""The whole pendulum test, knee, flesh and stopper included, against a second implementation of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from support.pendulum_oracle import Pendulum, Pose, solve

from certkit.definitions.loading.library import load
from certkit.mechanics import simulate

if TYPE_CHECKING:
    from certkit.definitions.legform import Legform
    from certkit.definitions.procedure import Procedure

UNTIL = 0.13


@pytest.fixture(scope="module")
def legform() -> Legform:
    """Return the shipped leg without friction in the knee."""
    return load("legform", "flex-pli-gtr", overrides={"knee.condyles.friction": "0"}).document


@pytest.fixture(scope="module")
def procedure() -> Procedure:
    return load("procedure", "pendulum", overrides={"run.until": "130 ms"}).document


@pytest.fixture(scope="module")
def ours(legform: Legform, procedure: Procedure) -> dict[str, float]:
    recording = simulate(procedure, legform).recording
    return {name: float(channel.values.max()) for name, channel in recording.channels.items()}


def peaks(pendulum: Pendulum, legform: Legform, poses: list[Pose]) -> dict[str, float]:
    gauges = {n: c for n, c in legform.channels.items() if c.measures == "bending moment"}
    heights = {name: legform.gauge_height(channel) for name, channel in gauges.items()}.items()
    found = {name: max(pendulum.moment(pose, height) for pose in poses) for name, height in heights}
    return found | {
        name: max(pendulum.elongation(pose, name) for pose in poses) for name in ("MCL", "ACL", "PCL")
    }


@pytest.mark.slow
def test_the_whole_pendulum_test_agrees_with_minimal_coordinates_within_0_1_per_cent(
    legform: Legform, procedure: Procedure, ours: dict[str, float]
):
    pendulum = Pendulum(legform, procedure)
    poses = solve(pendulum, np.arange(0, round(UNTIL / 1e-4) + 1) * 1e-4)
    for name, peak in peaks(pendulum, legform, poses).items():
        assert ours[name] == pytest.approx(peak, rel=1e-3), name


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::DeprecationWarning")  # Exudyn renames its settings now and then
def test_the_whole_pendulum_test_agrees_with_exudyn_within_half_a_per_cent(
    legform: Legform, procedure: Procedure, ours: dict[str, float]
):
    pytest.importorskip("exudyn")
    from support.pendulum_in_exudyn import solve_in_exudyn  # noqa: PLC0415  # skipped where Exudyn is not installed

    pendulum = Pendulum(legform, procedure)
    poses = solve_in_exudyn(pendulum, UNTIL, step=1e-4, sample=1e-4)
    for name, peak in peaks(pendulum, legform, poses).items():
        assert ours[name] == pytest.approx(peak, rel=5e-3), name


def test_at_first_contact_both_turn_about_the_hinge_with_the_speed_of_the_fall(
    legform: Legform, procedure: Procedure
):
    kinetic = simulate(procedure, legform).quality.energies["kinetic"][0]
    pendulum = Pendulum(legform, procedure)
    arms = np.concatenate([pendulum.centre, pendulum.centre + pendulum.flesh_height]) - pendulum.hinge
    masses = np.concatenate([pendulum.mass, pendulum.flesh_mass])
    about = masses @ arms**2 + pendulum.inertia.sum()
    assert kinetic == pytest.approx(0.5 * about * pendulum.rate**2, rel=1e-9)
