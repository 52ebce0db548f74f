"""Both dynamic tests as shipped, friction in the knee included, against a second implementation of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from support.inverse_oracle import Inverse
from support.pendulum_oracle import Pendulum

from certkit.definitions.loading.library import load
from certkit.mechanics import simulate
from certkit.signals.cfc import cfc

if TYPE_CHECKING:
    from support.leg_oracle import LegOracle

GRADED = ("T1", "T2", "T3", "T4", "MCL", "ACL", "PCL")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "oracle", "until"), [("pendulum", Pendulum, 0.125), ("inverse", Inverse, 0.045)]
)
def test_all_graded_peaks_agree_with_minimal_coordinates_within_0_2_per_cent(
    name: str, oracle: type[LegOracle], until: float
) -> None:
    legform = load("legform", "flex-pli-gtr").document
    procedure = load("procedure", name, overrides={"run.until": f"{until} s"}).document
    ours = simulate(procedure, legform).recording
    leg = oracle(legform, procedure)
    times, poses = leg.march(until, step=1e-5, stride=4)
    theirs = leg.channels(poses)
    interval = float(times[1])
    assert ours.interval == pytest.approx(interval)
    for channel in GRADED:
        expected = float(np.max(cfc(theirs[channel], interval, 180)))
        assert float(np.max(cfc(ours[channel].values, interval, 180))) == pytest.approx(expected, rel=2e-3)
