"""Channels through their filters: each once, and never one that cannot be."""

from __future__ import annotations

import numpy as np
import pytest
from support.curves import channel, half_sine, recording

from certkit.errors import DataError
from certkit.signals import Filtered, Recording, cfc

TIME = np.arange(0, 0.1, 1e-4)


def test_a_channel_asked_for_twice_is_filtered_once():
    filtered = Filtered(recording(TIME, {"T1": half_sine(TIME, 250.0)}))
    assert filtered.values("T1", "CFC 180") is filtered.values("T1", "CFC 180")


def test_channels_filtered_together_equal_channels_filtered_alone():
    rec = recording(TIME, {"T1": half_sine(TIME, 250.0), "MCL": half_sine(TIME, 0.02)})
    filtered = Filtered(rec, [("T1", "CFC 180"), ("MCL", "CFC 180"), ("T9", "CFC 180")])
    for name in ("T1", "MCL"):
        np.testing.assert_allclose(
            filtered.values(name, "CFC 180"), cfc(rec[name].values, 1e-4, 180.0), atol=1e-12
        )


def test_without_a_filter_the_samples_are_the_recorded_ones():
    rec = recording(TIME, {"T1": half_sine(TIME, 250.0)})
    assert Filtered(rec).values("T1", "none") is rec["T1"].values


def test_a_channel_that_has_seen_the_class_is_not_filtered_again():
    values = half_sine(TIME, 250.0)
    rec = Recording("measured", TIME, {"T1": channel("T1", values, filtered="CFC 180")})
    np.testing.assert_array_equal(Filtered(rec).values("T1", "CFC 180"), values)


def test_a_wider_pre_filter_does_not_count():
    values = half_sine(TIME, 250.0)
    rec = Recording("measured", TIME, {"T1": channel("T1", values, filtered="CFC 600")})
    np.testing.assert_allclose(Filtered(rec).values("T1", "CFC 180"), cfc(values, 1e-4, 180.0))


def test_a_narrower_pre_filter_cannot_be_undone():
    rec = Recording("measured", TIME, {"T1": channel("T1", half_sine(TIME, 1.0), filtered="CFC 60")})
    with pytest.raises(DataError, match="narrower than CFC 180"):
        Filtered(rec).values("T1", "CFC 180")


def test_a_missing_channel_says_so():
    with pytest.raises(DataError, match="`T1` was not recorded"):
        Filtered(recording(TIME, {})).values("T1", "none")


def test_a_channel_with_nan_says_how_many():
    values = half_sine(TIME, 250.0)
    values[3:5] = np.nan
    for words in ("none", "CFC 180"):
        with pytest.raises(DataError, match="2 of its 1000 values are not numbers"):
            Filtered(recording(TIME, {"T1": values}), [("T1", words)]).values("T1", words)


def test_a_channel_that_is_too_slow_names_itself():
    slow = np.arange(0, 0.1, 1e-3)
    with pytest.raises(DataError, match="channel `T1`: sampled at 1000 Hz"):
        Filtered(recording(slow, {"T1": half_sine(slow, 1.0)})).values("T1", "CFC 180")


def test_an_unknown_filter_is_refused():
    with pytest.raises(DataError, match="unknown filter `CFC 181`"):
        Filtered(recording(TIME, {"T1": half_sine(TIME, 1.0)})).values("T1", "CFC 181")


@pytest.mark.parametrize("order", [1, -1])
def test_a_window_holds_both_of_its_ends_whichever_way_the_axis_goes(order: int):
    time = np.arange(11) * 1e-3
    filtered = Filtered(recording(time[::order], {"T1": np.arange(11.0)}))
    inside = filtered.recording.time[filtered.within(2e-3, 5e-3)]
    np.testing.assert_allclose(sorted(inside), [2e-3, 3e-3, 4e-3, 5e-3])


def test_a_window_beyond_the_record_is_empty():
    filtered = Filtered(recording(TIME, {}))
    assert filtered.recording.time[filtered.within(0.5, 0.6)].size == 0
    assert filtered.recording.time[filtered.within(0.05, 0.04)].size == 0


def test_channels_of_different_lengths_are_looked_at_one_by_one():
    filtered = Filtered(recording(TIME, {"T1": np.array([1.0, np.nan]), "T2": np.ones(3)}))
    assert filtered.finite == {"T2"}
