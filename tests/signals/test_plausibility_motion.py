"""Whether a gauge moves as the others of its bone do."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.signals.plausibility_motion import turned_gauges

PHASE = np.linspace(0.0, 2 * np.pi, 1001)[:-1]


@pytest.mark.parametrize(("correlation", "turned"), [(0.9, 0), (-0.45, 0), (-0.55, 2), (-1.0, 2)])
def test_a_gauge_is_turned_when_it_goes_against_the_others(correlation: float, turned: int):
    against = correlation * np.sin(PHASE) + np.sqrt(1.0 - correlation**2) * np.cos(PHASE)
    found = turned_gauges({"T1": 200.0 * np.sin(PHASE), "T2": 150.0 * against})
    assert len(found) == turned
    assert list(found.values()) == pytest.approx([correlation] * turned)


def test_of_three_gauges_the_one_that_goes_against_both_is_turned():
    bone = {"T1": np.sin(PHASE), "T2": -np.sin(PHASE), "T3": np.sin(PHASE)}
    assert turned_gauges(bone) == pytest.approx({"T2": -1.0})
