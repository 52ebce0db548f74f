"""Jumps there and back: what a channel loses for a few samples, told from what a leg and noise show."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from certkit.signals.plausibility_steps import drop_out

INTERVAL = 2e-4
TIME = INTERVAL * np.arange(-250, 500)
PEAK = 100.0


def pulse(noise: float = 0.0) -> NDArray[np.float64]:
    """Return half a sine of 80 ms and 100 N·m at 5 kHz."""
    inside = (TIME > 0) & (TIME < 0.08)
    values = np.where(inside, PEAK * np.sin(np.pi * TIME / 0.08), 0.0)
    return values + noise * np.random.default_rng(7).normal(size=TIME.size)


@pytest.mark.parametrize("noise", [0.0, 0.3])
@pytest.mark.parametrize("count", [1, 2, 3, 5, 12, 40])
@pytest.mark.parametrize("at", [0.010, 0.025, 0.040, 0.060])
def test_samples_lost_to_zero_are_found_where_they_begin_and_end(at: float, count: int, noise: float):
    values = pulse(noise)
    begin = int(np.searchsorted(TIME, at))
    values[begin : begin + count] = 0.0
    assert drop_out(values, INTERVAL, PEAK) == (begin, begin + count)


def test_one_sample_that_sticks_out_is_found():
    values = pulse()
    values[400] += 0.15 * PEAK
    assert drop_out(values, INTERVAL, PEAK) == (400, 401)


def test_a_step_that_does_not_come_back_is_none():
    values = pulse()
    values[400:] -= 60.0
    assert drop_out(values, INTERVAL, PEAK) is None


@pytest.mark.parametrize("noise", [0.0, 1.0, 3.0])
def test_a_pulse_with_noise_has_none(noise: float):
    assert drop_out(pulse(noise), INTERVAL, PEAK) is None


def test_a_second_blow_of_its_own_is_none():
    values = pulse() + np.where(
        (TIME > 0.03) & (TIME < 0.033), 40.0 * np.sin(np.pi * (TIME - 0.03) / 0.003), 0.0
    )
    assert drop_out(values, INTERVAL, PEAK) is None
