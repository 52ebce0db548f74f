"""Each gate decides alone: one fault in an intact test, and its criterion is not evaluated for it."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Literal

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray

from certkit.bench.setup import prepare
from certkit.documents.result import Result
from certkit.errors import DataError
from certkit.grading import evaluate, measure_all
from certkit.reporting.language import worded
from certkit.signals import Recording
from certkit.signals.cfc import cfc
from tests.support.laboratory_records import as_measured, leg_channels

Floats = NDArray[np.float64]
VEHICLE = 3
"""The front whose test passes."""


@cache
def intact() -> Recording:
    """Return a vehicle test with little noise, at 10 kHz or more, that passes."""
    conditions = {
        "speed": 11.1,
        "temperature": 293.15,
        "humidity": 0.4,
        "end above ground": 0.075,
    }
    return replace(as_measured(leg_channels(VEHICLE), 5), conditions=conditions)


def damaged(channel: str, change: Callable[[Floats, Floats], Floats]) -> Recording:
    """Return the intact test with one channel changed; `change` takes time and values."""
    record = intact()
    kept = record[channel]
    values = change(record.time, kept.values.copy())
    return replace(record, channels={**record.channels, channel: replace(kept, values=values)})


def graded(record: Recording, *, lenient: bool = False) -> Result:
    setup = prepare("vehicle")
    measured = measure_all(setup.procedure, record, lenient=lenient)
    return worded(evaluate(measured, setup.terms()))


def reason(result: Result, criterion: str) -> str:
    """Return the code of the one criterion's reason; the others have none."""
    others = [c.id for c in result.criteria if c.graded and c.id != criterion and c.coded_reason is not None]
    assert others == []
    found = result.criteria[criterion]
    assert found.verdict == "not evaluated"
    assert found.coded_reason is not None
    return found.coded_reason.code


def test_the_intact_test_passes():
    result = graded(intact())
    assert result.verdict == "pass", [c.reason for c in result.criteria]


def zero(_: Floats, values: Floats) -> Floats:
    return np.zeros_like(values)


def constant(_: Floats, values: Floats) -> Floats:
    return np.full_like(values, 0.004)


def noise_only(time: Floats, values: Floats) -> Floats:
    return 4e-5 * np.random.default_rng(3).normal(size=values.size) + 0.0 * time


def frozen(time: Floats, values: Floats) -> Floats:
    at, until = np.searchsorted(time, [0.027, 0.041])
    step = values[at] - values[until]
    values[at:until] = values[at]
    values[until:] += step
    return values


def turned(_: Floats, values: Floats) -> Floats:
    return -values


def tenth(_: Floats, values: Floats) -> Floats:
    return 0.1 * values


def drop_out(time: Floats, values: Floats) -> Floats:
    values[int(np.searchsorted(time, 0.022))] = 0.0
    return values


def lost(share: float, count: int) -> Callable[[Floats, Floats], Floats]:
    """Lose samples early on the flank, where a leg could make a step as large as that to rest."""

    def change(time: Floats, values: Floats) -> Floats:
        rest = float(np.median(values[time < 0]))
        flank = int(np.flatnonzero((time > 0) & (values - rest > share * np.ptp(values)))[0])
        values[flank : flank + count] = rest
        return values

    return change


def spike(time: Floats, values: Floats) -> Floats:
    values[int(np.searchsorted(time, 0.020))] += 0.2 * values.max()
    return values


def overflow(time: Floats, values: Floats) -> Floats:
    at = int(np.searchsorted(time, 0.024))
    values[at : at + 3] -= 380.0
    return values


def cut_flat(time: Floats, values: Floats) -> Floats:
    return np.minimum(values, 0.9 * values.max()) + 0.0 * time


def cut_with_a_toggling_digit(time: Floats, values: Floats) -> Floats:
    return np.minimum(values, 0.9 * values.max() + 0.01 * (np.arange(time.size) % 2))


def cut_with_noise(time: Floats, values: Floats) -> Floats:
    cut = np.minimum(values, 0.85 * values.max())
    return cut + 0.05 * np.random.default_rng(4).normal(size=time.size)


@pytest.mark.parametrize(
    ("channel", "change", "code"),
    [
        ("MCL", zero, "channel-dead"),
        ("ACL", zero, "channel-dead"),
        ("MCL", constant, "channel-dead"),
        ("MCL", noise_only, "channel-dead"),
        ("MCL", turned, "moves-wrong-way"),
        ("T2", turned, "gauge-turned"),
        ("MCL", tenth, "unit-out-by-ten"),
        ("T2", drop_out, "impossible-step"),
        ("MCL", drop_out, "impossible-step"),
        ("T3", overflow, "impossible-step"),
        ("T4", lost(0.17, 3), "drop-out"),
        ("PCL", lost(0.11, 3), "drop-out"),
        ("T4", spike, "drop-out"),
    ],
)
def test_a_channel_that_cannot_have_shown_the_blow_is_not_evaluated(
    channel: str, change: Callable[[Floats, Floats], Floats], code: str
):
    result = graded(damaged(channel, change))
    assert result.criteria[channel].coded_reason is not None
    assert result.criteria[channel].coded_reason.code == code
    assert result.verdict == "not evaluated"
    assert result.criteria[channel].reason in " ".join(result.remarks)


@pytest.mark.parametrize("change", [cut_flat, cut_with_a_toggling_digit, cut_with_noise])
def test_a_clipped_channel_is_refused_and_when_lenient_not_evaluated(
    change: Callable[[Floats, Floats], Floats],
):
    record = damaged("T1", change)
    try:
        found = reason(graded(record), "T1")
    except DataError:
        found = "clipped"
    assert found == "clipped"
    result = graded(record, lenient=True)
    assert reason(result, "T1") in {"clipped-kept", "clipped"}
    assert result.verdict == "not evaluated"


def test_a_channel_that_stands_still_while_the_others_move_is_not_evaluated():
    result = graded(damaged("T2", frozen))
    found = result.criteria["T2"]
    assert found.verdict == "not evaluated"
    assert found.coded_reason is not None
    assert found.coded_reason.code == "channel-frozen"


def test_an_interval_that_a_dead_bone_helped_to_find_is_no_evidence():
    result = graded(damaged("F1", zero))
    assert {c.coded_reason.code for c in result.criteria if c.graded and c.coded_reason} == {
        "interval-rests-on-doubt"
    }


def test_two_gauges_that_no_leg_shows_together_are_remarked():
    result = graded(damaged("T2", lambda _, values: 0.3 * values))
    assert any("off the line between T1 and T3" in remark for remark in result.remarks)
    assert not any("off the line" in remark for remark in graded(intact()).remarks)


@pytest.mark.parametrize("end", [0.010, 0.020, 0.030])
def test_a_vehicle_record_that_ends_before_the_interval_does_is_not_evaluated(end: float):
    record = intact()
    inside = record.time <= end
    channels = {n: replace(c, values=c.values[inside]) for n, c in record.channels.items()}
    result = graded(replace(record, time=record.time[inside], channels=channels))
    assert result.verdict == "not evaluated"
    assert result.interval is None
    assert "no assessment interval" in " ".join(result.remarks)


def test_a_record_that_begins_after_contact_is_not_evaluated():
    record = intact()
    inside = record.time >= 0.003
    channels = {n: replace(c, values=c.values[inside]) for n, c in record.channels.items()}
    conditions = {**record.conditions, "free-flight noise": 1.0}
    late = replace(record, time=record.time[inside], channels=channels, conditions=conditions)
    result = graded(late)
    assert {c.coded_reason.code for c in result.criteria if c.graded and c.coded_reason} == {
        "record-begins-late"
    }


@pytest.mark.parametrize("kind", ["measured", "virtual", "simulated"])
def test_a_flat_top_is_suspect_in_whatever_was_read_from_a_file(
    kind: Literal["measured", "virtual", "simulated"],
):
    record = damaged("T1", lambda _, values: np.minimum(values, 0.85 * values.max()))
    measured = measure_all(prepare("vehicle").procedure, replace(record, kind=kind), lenient=True)
    doubt = measured.values["T1"].doubt
    assert doubt is not None
    assert doubt.code in {"clipped", "clipped-kept"}


def test_a_flat_top_that_comes_straight_from_the_solver_is_one():
    record = damaged("T1", lambda _, values: np.minimum(values, 0.85 * values.max()))
    solved = replace(record, kind="simulated", from_solver=True)
    measured = measure_all(prepare("vehicle").procedure, solved, lenient=True)
    assert measured.values["T1"].doubt is None


def test_a_smeared_top_of_a_filtered_clipped_channel_is_found_too():
    record = intact()
    smeared = damaged("T1", lambda _, v: cfc(np.minimum(v, 0.8 * v.max()), record.interval, 600))
    result = graded(smeared, lenient=True)
    assert reason(result, "T1") in {"clipped", "clipped-kept"}


def test_a_channel_that_is_driven_into_its_limits_after_the_interval_is_evidence():
    late = damaged("T1", lambda time, v: np.where(time > 0.08, np.where(time < 0.1, 400.0, -390.0), v))
    result = graded(late)
    assert result.interval is not None
    assert result.interval[1] < 0.07
    assert result.verdict == "pass", [c.reason for c in result.criteria]


def test_two_channels_that_share_one_noise_are_one_sensor_recorded_twice():
    record = intact()
    copy = damaged("T3", lambda _, v: 0.75 * record["T2"].values + 0.0 * v)
    result = graded(copy)
    reasons = {name: result.criteria[name].coded_reason for name in ("T2", "T3")}
    assert {n: r.code for n, r in reasons.items() if r is not None} == dict.fromkeys(
        ("T2", "T3"), "channel-copied"
    )
    assert result.verdict == "not evaluated"


def test_a_record_sampled_too_slowly_is_told_with_its_file():
    record = intact()
    slow = {n: replace(c, values=c.values[::20]) for n, c in record.channels.items()}
    with pytest.raises(DataError, match=r"good 5: sampled at 1000 Hz.*export the channel at its full"):
        graded(replace(record, time=record.time[::20], channels=slow))
