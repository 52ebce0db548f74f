"""Gates that a pendulum test shows best: each decides alone, on one fault in an intact test."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from msgspec.structs import replace
from numpy.typing import NDArray

from certkit.bench.setup import prepare
from certkit.grading import Measurements, measure_all
from certkit.signals import Recording
from tests.support.laboratory_records import as_measured, leg_channels

Floats = NDArray[np.float64]
PENDULUM = 0


@cache
def intact() -> Recording:
    return as_measured(leg_channels(PENDULUM), 5)


def measured(record: Recording, *, lenient: bool = False) -> Measurements:
    return measure_all(prepare("pendulum").procedure, record, lenient=lenient)


def damaged(channel: str, change: Callable[[Floats, Floats], Floats]) -> Recording:
    """Return the intact test with one channel changed; `change` takes time and values."""
    record = intact()
    values = change(record.time, record[channel].values.copy())
    return replace(record, channels={**record.channels, channel: replace(record[channel], values=values)})


def doubts(found: Measurements) -> dict[str, str]:
    """Return the code of each graded criterion's doubt."""
    graded = {criterion.id for criterion in found.procedure.criteria if criterion.corridor is not None}
    return {name: v.doubt.code for name, v in found.values.items() if v.doubt is not None and name in graded}


def cut(begin: float, end: float) -> Recording:
    record = intact()
    inside = (record.time >= begin) & (record.time <= end)
    channels = {n: replace(c, values=c.values[inside]) for n, c in record.channels.items()}
    return replace(record, time=record.time[inside], channels=channels)


def peak_time(channel: str) -> float:
    record = intact()
    return float(record.time[np.argmax(record[channel].values)])


def test_the_intact_test_casts_no_doubt():
    found = measured(intact())
    assert doubts(found) == {}
    assert found.remarks == ()


def test_a_channel_that_moves_before_the_others_is_shifted_in_time():
    early = damaged("MCL", lambda t, v: np.interp(t + 0.030, t, v))
    assert doubts(measured(early)) == {"MCL": "moves-before-contact"}


@pytest.mark.parametrize(
    ("change", "code"),
    [
        (lambda t, v: v + 0.04 * (t - t[0]) / 1e-3, "drifts-at-rest"),
        (lambda t, v: v + 17.0 * np.sin(2 * np.pi * 50.0 * t), "swings-at-rest"),
    ],
)
def test_a_channel_that_is_not_at_rest_before_contact_is_remarked_upon(
    change: Callable[[Floats, Floats], Floats], code: str
):
    found = measured(damaged("T1", change))
    assert [(r.code, r.parameters["channel"]) for r in found.remarks] == [(code, "T1")]


def test_what_was_kept_leniently_is_no_evidence():
    turned = damaged("T1", lambda _, v: -v)
    assert doubts(measured(turned, lenient=True)) == {"T1": "sign-turned"}


def test_a_record_that_ends_at_a_peak_shows_a_flank():
    found = doubts(measured(cut(-1.0, peak_time("T1") - 0.002)))
    assert found["T1"] == "peak-at-last-sample"


def test_a_record_that_ends_soon_after_a_peak_may_have_missed_the_largest():
    found = doubts(measured(cut(-1.0, max(peak_time(name) for name in ("T1", "T2", "T3")) + 0.004)))
    assert found["T1"] == "record-ends-early"


def test_a_record_that_begins_on_the_flank_shows_a_late_trigger():
    late = cut(0.025, 1.0)
    found = doubts(measured(replace(late, time=late.time - 0.025)))
    assert found["T1"] == "loaded-before-contact"
