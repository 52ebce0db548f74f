"""A static test records states at rest: longer waiting or other damping changes nothing that counts."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.bench.setup import prepare
from certkit.definitions.fixtures import loading_ram
from certkit.definitions.fixtures.loading_ram import LevelPace
from certkit.mechanics import simulate


@pytest.mark.parametrize("procedure", ["static-femur", "static-tibia", "static-knee"])
def test_a_level_is_held_until_all_is_at_rest(procedure: str, monkeypatch: pytest.MonkeyPatch) -> None:
    setup = prepare(procedure)
    reported = simulate(setup.procedure, setup.legform).recording
    for name in ("ON_BONE", "ON_KNEE"):
        monkeypatch.setattr(loading_ram, name, LevelPace(0.010, 0.120, 300.0))
    patient = simulate(setup.procedure, setup.legform, time_step=2e-5).recording
    for name, channel in reported.channels.items():
        there = patient[name].values
        assert np.abs(channel.values - there).max() <= 1e-3 * np.abs(there).max(), name
