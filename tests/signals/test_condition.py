"""Conditioning of measured tests, step by step and as a whole."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from support.curves import Floats, channel, half_sine, recording

from certkit.errors import DataError
from certkit.reasons import Reason
from certkit.signals.clipping import AT_CLASS, Clipping, beyond_class, find_clipping
from certkit.signals.condition import (
    Situation,
    noise_noted,
    offset_free,
    right_way_round,
    timed,
    unclipped,
    uniform,
)
from certkit.signals.noise import FREE_FLIGHT_NOISE, free_flight
from certkit.signals.polarity import is_swapped
from certkit.signals.time_zero import first_contact

TIME = np.arange(-2000, 10000) * 2e-5  # 40 ms before contact, 200 ms after it
CERTIFIED = Situation(dynamic=True, free_flight=False, signs_known=True)
FLYING = Situation(dynamic=True, free_flight=True, signs_known=False)
STATIC = Situation(dynamic=False, free_flight=False, signs_known=False)
LENIENT = replace(CERTIFIED, lenient=True)


def test_an_offset_at_rest_is_taken_off_and_noted():
    rec = offset_free(recording(TIME, {"T1": half_sine(TIME, 250.0) + 3.5}), CERTIFIED)
    assert rec["T1"].values.max() == pytest.approx(250.0, abs=1e-9)
    assert rec["T1"].notes == (Reason.of("offset-removed", offset=3.5, unit="N·m"),)
    assert [note.code for note in rec.notes] == ["offsets-removed"]


def test_forces_keep_their_offset():
    rec = offset_free(recording(TIME, {"contact force": half_sine(TIME, 5e3) + 12.0}), CERTIFIED)
    assert rec["contact force"].values[0] == pytest.approx(12.0)


def test_without_5_ms_at_rest_no_offset_is_removed():
    time = TIME[TIME >= -0.004]
    rec = offset_free(recording(time, {"T1": half_sine(time, 250.0) + 3.5}), CERTIFIED)
    assert rec["T1"].values[0] == pytest.approx(3.5)
    assert rec.notes[0].code == "no-offset-removed"


def test_what_begins_within_the_last_2_ms_before_contact_is_no_offset():
    early = np.where((TIME > -0.0019) & (TIME < 0.0), 40.0, 0.0)
    rec = offset_free(recording(TIME, {"T1": early + 3.5}), CERTIFIED)
    assert rec["T1"].values[0] == pytest.approx(0.0, abs=1e-9)


def test_the_last_30_ms_of_a_free_flight_are_not_used_for_the_offset():
    time = np.arange(-2500, 5000) * 2e-5
    moving = np.where(time > -0.030, 8.0, 2.0)
    rec = offset_free(recording(time, {"T1": moving}), FLYING)
    assert rec["T1"].values[0] == pytest.approx(0.0)
    assert free_flight(rec).largest == pytest.approx(6.0)


def test_free_flight_noise_becomes_a_condition_of_the_test():
    wobble = np.where(TIME < 0, 11.0 * np.sin(2 * np.pi * 100 * TIME), 0.0)
    rec = noise_noted(recording(TIME, {"T1": wobble, "T2": 0.5 * wobble}), FLYING)
    assert rec.conditions[FREE_FLIGHT_NOISE] == pytest.approx(11.0, rel=1e-3)


def test_a_record_without_30_ms_before_contact_has_no_noise_figure():
    time = TIME[TIME >= -0.020]
    assert free_flight(recording(time, {"T1": np.zeros_like(time)})) is None
    assert (
        FREE_FLIGHT_NOISE not in noise_noted(recording(time, {"T1": np.zeros_like(time)}), FLYING).conditions
    )


def test_a_channel_at_its_amplitude_class_is_clipped():
    values = np.minimum(half_sine(TIME, 460.0), 400.0)
    with pytest.raises(DataError, match=r"`T1` is clipped at 400 N·m from .* ms on"):
        unclipped(recording(TIME, {"T1": values}), CERTIFIED)


def test_an_amplifier_that_cuts_off_below_the_class_is_found_too():
    values = np.minimum(half_sine(TIME, 250.0), 200.0)
    found = find_clipping(values, 400.0)
    assert found is not None
    assert found.level == 200.0


def test_a_channel_that_goes_on_beyond_its_class_was_not_cut_off_there():
    """As the elongation of a ligament that has torn: a round peak, for which no measuring chain vouches."""
    values = half_sine(TIME, 460.0)
    assert find_clipping(values, 400.0) is None
    assert beyond_class(values, 400.0) == Clipping(460.0, int(np.argmax(values > 400.0 / AT_CLASS)))
    assert beyond_class(half_sine(TIME, 399.0), 400.0) is None
    rec = recording(TIME, {"T1": values})
    with pytest.raises(DataError, match=r"`T1` goes beyond its amplitude class, to 460 N·m, from "):
        unclipped(rec, CERTIFIED)
    assert unclipped(rec, LENIENT)["T1"].notes[0].code == "beyond-class-kept"
    assert unclipped(replace(rec, kind="simulated"), CERTIFIED)["T1"].notes == ()


@pytest.mark.parametrize("level", [-0.5, 0.0, 0.4])
def test_a_channel_that_has_dropped_to_a_plateau_was_not_cut_off(level: float):
    """As that of a sensor that was torn off after the peak."""
    values = half_sine(TIME, 250.0)
    dropped = np.where(np.arange(TIME.size) > values.argmax() + 20, level * 250.0, values)
    assert find_clipping(dropped, 400.0) is None


def test_a_clipped_rebound_is_found():
    assert find_clipping(np.maximum(half_sine(TIME, -250.0), -180.0)) is not None


@pytest.mark.parametrize("digit", [1e-6, 0.01, 0.1, 1.0])
def test_a_smooth_peak_read_with_few_digits_is_not_clipped(digit: float):
    rough = np.round(half_sine(TIME, 250.0) / digit) * digit
    assert find_clipping(rough, 400.0) is None


def test_a_channel_at_rest_is_not_clipped():
    assert find_clipping(np.zeros(1000), 400.0) is None
    assert find_clipping(np.full(1000, 3.0), 400.0) is None


def test_lenient_keeps_a_clipped_channel_with_a_note():
    rec = unclipped(recording(TIME, {"T1": np.minimum(half_sine(TIME, 460.0), 400.0)}), LENIENT)
    clipped = rec["T1"].notes[0]
    assert (clipped.code, clipped.parameters["level"]) == ("clipped-kept", 400.0)


def test_a_swapped_tibia_channel_is_refused():
    with pytest.raises(DataError, match="`T2` has its polarity swapped"):
        right_way_round(recording(TIME, {"T2": half_sine(TIME, -250.0)}), CERTIFIED)


def test_lenient_turns_a_swapped_channel_with_a_note():
    rec = right_way_round(recording(TIME, {"T2": half_sine(TIME, -250.0)}), LENIENT)
    assert rec["T2"].values.max() == pytest.approx(250.0)
    assert rec["T2"].notes[0] == Reason.of("sign-turned")


@pytest.mark.parametrize("situation", [CERTIFIED, LENIENT], ids=["strict", "lenient"])
def test_a_spike_is_no_swap_and_turns_no_channel(situation: Situation):
    spiked = half_sine(TIME, 250.0)
    spiked[int(np.argmax(spiked)) + 40] = -9999.0
    kept = right_way_round(recording(TIME, {"T2": spiked}), situation)["T2"]
    assert np.array_equal(kept.values, spiked)
    assert kept.notes == ()


def test_a_rebound_is_no_swap_until_it_is_half_as_large_again_as_the_peak():
    peak = half_sine(TIME, 100.0)
    assert not is_swapped(peak - half_sine(TIME, 145.0, start=0.06))
    assert is_swapped(peak - half_sine(TIME, 155.0, start=0.06))
    assert not is_swapped(np.zeros(100))
    assert not is_swapped(np.array([]))


def test_femur_moments_may_have_either_sign():
    right_way_round(recording(TIME, {"F1": half_sine(TIME, -250.0)}), CERTIFIED)


@pytest.mark.parametrize("late", [0.030, -0.015, 0.120, 0.0055])
def test_a_wrong_trigger_is_moved_to_first_contact(late: float):
    rec = timed(recording(TIME + late, {"T1": half_sine(TIME, 250.0)}), CERTIFIED)
    assert first_contact(rec).time == pytest.approx(0.0, abs=0.001)
    assert rec.notes[0].code == "time-zero-moved"


@pytest.mark.parametrize("early", [0.0045, 0.0, -0.001])
def test_a_trigger_up_to_5_ms_before_contact_and_2_ms_behind_it_is_kept(early: float):
    rec = recording(TIME + early, {"T1": half_sine(TIME, 250.0)})
    assert timed(rec, CERTIFIED) is rec


def test_nothing_is_loaded_before_it_is_hit():
    rec = timed(recording(TIME - 0.004, {"T1": half_sine(TIME, 250.0)}), CERTIFIED)
    assert first_contact(rec).time == pytest.approx(0.0, abs=0.001)


@pytest.mark.parametrize("phase", [0.0, 1.5, 3.0, 4.5])
def test_a_leg_that_swings_in_flight_is_not_taken_for_hit(phase: float):
    """Within the 15 N·m that a tibia may show in flight, and more than the 5 % of its peak that a rise is."""
    swing = 12.0 * np.cos(2 * np.pi * 25.0 * TIME + phase) * np.where(TIME < 0, 1.0, np.exp(-TIME / 0.01))
    rec = recording(TIME, {"T1": swing + half_sine(TIME, 180.0)})
    assert timed(rec, FLYING) is rec


def test_contact_is_found_in_noise():
    noise = np.random.default_rng(5).normal(0, 1.0, TIME.size)
    found = first_contact(recording(TIME, {"T1": half_sine(TIME, 250.0) + noise}))
    assert found.time == pytest.approx(0.0, abs=0.002)
    assert found.channel == "T1"


@pytest.mark.parametrize("begin", [0.0, 0.010])
def test_a_record_that_begins_at_contact_keeps_its_time_zero(begin: float):
    time = np.arange(10000) * 2e-5
    rec = recording(
        time, {"contact force": half_sine(time + begin, 5e3), "F1": half_sine(time, 100.0, start=0.02)}
    )
    assert first_contact(rec) is None
    assert timed(rec, CERTIFIED) is rec


def test_a_silent_record_has_no_contact():
    assert first_contact(recording(TIME, {"T1": np.zeros_like(TIME)})) is None
    assert first_contact(recording(TIME, {"knee bend": half_sine(TIME, 1.0)})) is None


def test_uneven_time_steps_are_refused():
    time = TIME.copy()
    time[500] += 1e-5
    with pytest.raises(DataError, match="time steps are not equal"):
        uniform(recording(time, {"T1": half_sine(TIME, 1.0)}), CERTIFIED)


def test_two_time_bases_are_refused():
    rec = replace(recording(TIME, {}), channels={"T1": channel("T1", np.zeros(TIME.size - 1))})
    with pytest.raises(DataError, match="different lengths"):
        uniform(rec, CERTIFIED)


@pytest.mark.parametrize(
    "time", [np.array([]), np.array([0.0]), np.array([0.0, np.nan]), np.array([1.0, 0.0])]
)
def test_a_time_axis_that_is_none_is_refused(time: Floats):
    with pytest.raises(DataError):
        uniform(recording(time, {"T1": np.zeros_like(time)}), CERTIFIED)


def test_load_levels_of_a_static_test_need_no_even_steps():
    levels = np.array([0.0, 1.0, 3.0])
    rec = recording(levels, {"mid moment": levels})
    for step in (uniform, unclipped, timed, offset_free, right_way_round, noise_noted):
        assert step(rec, STATIC) is rec


def test_channels_with_nan_are_left_for_whoever_measures_on_them():
    values = half_sine(TIME, -250.0)
    values[7] = np.nan
    rec = recording(TIME, {"T1": values})
    for step in (unclipped, offset_free, right_way_round):
        assert np.isnan(step(rec, CERTIFIED)["T1"].values[7])
