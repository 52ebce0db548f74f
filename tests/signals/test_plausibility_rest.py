"""At rest: noise that two channels share, drift and hum, told from what good amplifiers show."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from certkit.signals.plausibility_rest import copies, drift_until_peak, is_silent, swing_at_rest

TIME = 1e-4 * np.arange(400)
HUM = np.sin(2 * np.pi * 50.0 * TIME)


def noise(seed: int, size: float = 0.4) -> NDArray[np.float64]:
    return size * np.random.default_rng(seed).normal(size=TIME.size)


def test_a_scaled_and_rounded_copy_is_found():
    one = noise(1)
    rest = {"T1": one, "T2": np.round(-0.81 * one, 2), "T3": noise(2)}
    assert copies(rest) == [("T1", "T2")]


def test_the_same_hum_in_all_channels_makes_no_copies():
    assert copies({name: 5.0 * HUM + noise(k) for k, name in enumerate(("T1", "T2", "T3"))}) == []


def test_what_a_filter_lets_through_of_the_blow_makes_no_copies():
    """A filter without phase brings the begin of the blow forward, to all channels alike."""
    foot = np.exp((TIME - TIME[-1]) / 1e-3)
    rest = {
        name: share * foot + noise(k, 1e-6) for k, (name, share) in enumerate({"T1": 9.0, "T2": 7.0}.items())
    }
    assert copies(rest) == []


def test_channels_without_noise_are_no_copies():
    assert copies({"T1": np.zeros(400), "T2": np.zeros(400), "T3": np.repeat([0.0, 0.1], 200)}) == []


@pytest.mark.parametrize(("per_sample", "found"), [(0.01, True), (-0.01, True), (0.0005, False)])
def test_a_drift_at_rest_is_taken_to_the_peak(per_sample: float, *, found: bool):
    share = drift_until_peak(per_sample * np.arange(400) + noise(3, 0.1), 800, 250.0)
    assert (share is not None) == found
    if share is not None:
        assert share == pytest.approx(per_sample * 800 / 250.0, rel=0.05)


def test_hum_is_a_swing_and_no_drift():
    assert drift_until_peak(10.0 * HUM, 800, 250.0) is None
    assert swing_at_rest(20.0 * HUM, 250.0) == pytest.approx(0.16, rel=0.01)
    assert swing_at_rest(10.0 * HUM, 250.0) is None


@pytest.mark.parametrize(
    ("deviation", "digit", "silent"),
    [(0.0, 1e-6, True), (0.0, 0.1, False), (1e-4, 1e-6, False), (0.02, 0.1, False)],
    ids=["simulated", "coarse digits", "a quiet amplifier", "noise below a digit"],
)
def test_no_noise_where_digits_would_show_it_is_no_amplifier(deviation: float, digit: float, *, silent: bool):
    rest = 3.0 + noise(4, deviation)
    place = np.linspace(0.0, np.pi, 4000)
    blow = 250.0 * np.sin(place) * np.exp(-0.3 * place)
    values = np.round(np.concatenate([rest, 3.0 + blow]) / digit) * digit
    assert is_silent(values[: rest.size], values, 400.0) == silent
