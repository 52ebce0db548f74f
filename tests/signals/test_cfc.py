"""The CFC filter against its gain, against scipy's recursion and against what it must not do."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from certkit.definitions.filters import FILTERS
from certkit.errors import DataError
from certkit.signals import cfc
from certkit.signals.cfc import DESIGN_RATIO

INTERVAL = 1e-5


def gain_at(frequency: float, frequency_class: float):
    """Return the gain in decibels, far from the ends of a long sine."""
    time = np.arange(0, 0.5, INTERVAL)
    middle = slice(time.size // 4, 3 * time.size // 4)
    filtered = cfc(np.sin(2 * np.pi * frequency * time), INTERVAL, frequency_class)
    return 20 * np.log10(np.abs(filtered[middle]).max())


@pytest.mark.parametrize("frequency_class", [60.0, 180.0, 600.0, 1000.0])
def test_gain_at_the_class_is_minus_a_tenth_to_half_a_decibel(frequency_class: float):
    assert gain_at(frequency_class, frequency_class) == pytest.approx(-0.45, abs=0.05)


@pytest.mark.parametrize("frequency_class", [60.0, 180.0, 600.0, 1000.0])
def test_gain_at_the_class_over_0_6_is_minus_3_decibels_within_the_standards_band(frequency_class: float):
    """ISO 6487 allows −1 to −4 dB at CFC/0.6."""
    assert gain_at(frequency_class / 0.6, frequency_class) == pytest.approx(-3.0, abs=0.15)


def test_far_above_the_class_the_filter_falls_by_24_decibels_an_octave():
    fall = gain_at(1600.0, 180.0) - gain_at(3200.0, 180.0)
    assert fall == pytest.approx(24.0, abs=0.5)


@pytest.mark.parametrize("words", list(FILTERS))
@pytest.mark.parametrize("samples", [300, 2000, 20000])
def test_it_is_the_recursive_filter_run_forward_and_backward(words: str, samples: int):
    signal = pytest.importorskip("scipy.signal")
    values = np.cumsum(np.random.default_rng(7).normal(size=(3, samples)), axis=1)
    interval = 2e-5
    design = DESIGN_RATIO * FILTERS[words].frequency_class
    sections = signal.butter(2, design, fs=1 / interval, output="sos")
    pad = int(np.ceil(27.6 / (np.sqrt(2) * np.tan(np.pi * design * interval))))
    reach = min(pad, samples - 1)
    odd = np.concatenate(
        [
            2 * values[:, :1] - values[:, reach:0:-1],
            values,
            2 * values[:, -1:] - values[:, -2 : -reach - 2 : -1],
        ],
        axis=1,
    )
    level = np.pad(odd, ((0, 0), (pad, pad)), mode="edge")
    expected = signal.sosfiltfilt(sections, level, padtype=None)[:, pad + reach : pad + reach + samples]
    # padtype=None starts from the first value at rest, which the level ends are.
    scale = np.abs(values).max()
    np.testing.assert_allclose(
        cfc(values, interval, FILTERS[words].frequency_class), expected, atol=1e-9 * scale, rtol=0
    )


def test_a_constant_and_a_ramp_pass_unchanged():
    ramp = np.linspace(-3.0, 5.0, 5000)
    np.testing.assert_allclose(cfc(np.full(5000, 7.0), INTERVAL, 180.0), 7.0, rtol=1e-12)
    np.testing.assert_allclose(cfc(ramp, INTERVAL, 180.0), ramp, atol=1e-9)


def test_filtering_forward_and_backward_shifts_no_peak():
    time = np.arange(0, 0.1, INTERVAL)
    pulse = np.exp(-(((time - 0.05) / 0.004) ** 2))
    assert time[np.argmax(cfc(pulse, INTERVAL, 180.0))] == pytest.approx(0.05, abs=INTERVAL)


def test_channels_are_filtered_each_for_itself():
    rng = np.random.default_rng(3)
    rows = rng.normal(size=(4, 3000))
    together = cfc(rows, INTERVAL, 180.0)
    for row, filtered in zip(rows, together, strict=True):
        np.testing.assert_allclose(cfc(row, INTERVAL, 180.0), filtered, atol=1e-13)


def test_a_sampling_rate_under_ten_times_the_class_is_refused():
    with pytest.raises(DataError, match="CFC 180 needs at least 1800 Hz"):
        cfc(np.zeros(100), 1 / 1700, 180.0)
    cfc(np.zeros(100), 1 / 1800, 180.0)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_value_that_is_not_a_number_is_refused(bad: float):
    values = np.zeros(100)
    values[40] = bad
    with pytest.raises(DataError, match="not a number"):
        cfc(values, INTERVAL, 180.0)


def test_a_single_sample_is_refused():
    with pytest.raises(DataError, match="cannot be filtered"):
        cfc(np.zeros(1), INTERVAL, 180.0)


@given(st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=60), st.floats(-10, 10), st.floats(-100, 100))
def test_the_filter_is_linear_and_keeps_the_length(values: list[float], factor: float, offset: float):
    x = np.array(values)
    base = cfc(x, 1e-4, 180.0)
    assert base.shape == x.shape
    np.testing.assert_allclose(cfc(factor * x + offset, 1e-4, 180.0), factor * base + offset, atol=1e-7)


@given(st.lists(st.floats(-1e3, 1e3), min_size=2, max_size=60))
def test_reversed_time_gives_the_reversed_result(values: list[float]):
    x = np.array(values)
    np.testing.assert_allclose(cfc(x[::-1], 1e-4, 180.0), cfc(x, 1e-4, 180.0)[::-1], atol=1e-8)
