"""A record that ends before its peaks, or begins after them, never passes: the shipped test, cut."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from msgspec.structs import replace

from certkit.bench.setup import Setup, prepare
from certkit.errors import DataError
from certkit.exchange.read import read_recording
from certkit.grading import grade_criteria, measure_all, overall

if TYPE_CHECKING:
    from certkit.documents.result import Verdict
    from certkit.signals import Recording

SHIPPED = Path(__file__).parents[2] / "examples/measured/FLX-0007-pendulum.zip"


@pytest.fixture(scope="module")
def setup() -> Setup:
    return prepare("pendulum")


@pytest.fixture(scope="module")
def whole() -> Recording:
    return read_recording(SHIPPED).recording


def cut(recording: Recording, first: float, last: float) -> Recording:
    """Return the samples from `first` to `last`, s."""
    inside = (recording.time >= first - 1e-9) & (recording.time <= last + 1e-9)
    channels = {n: replace(c, values=c.values[inside]) for n, c in recording.channels.items()}
    return replace(recording, time=recording.time[inside], channels=channels)


def verdict(setup: Setup, recording: Recording) -> Verdict | None:
    """Return the verdict; None where the record is refused."""
    try:
        measured = measure_all(setup.procedure, recording)
    except DataError:
        return None
    return overall(grade_criteria(measured, setup.terms().corridors))


def peaks(recording: Recording, setup: Setup) -> dict[str, float]:
    graded = [c.id for c in setup.procedure.criteria if c.corridor is not None]
    return {n: float(recording.time[np.argmax(recording[n].values)]) for n in graded}


def test_the_whole_record_passes(setup: Setup, whole: Recording):
    assert verdict(setup, whole) == "pass"


def test_cut_at_every_millisecond_it_passes_only_with_all_peaks_inside(setup: Setup, whole: Recording):
    begin = float(whole.time[0])
    last = max(peaks(whole, setup).values())
    passed = []
    for length in range(5, 200):
        end = begin + length * 1e-3
        if verdict(setup, cut(whole, begin, end)) == "pass":
            passed.append(end)
    assert passed
    assert min(passed) > last


def test_begun_at_every_millisecond_it_passes_only_with_all_peaks_inside(setup: Setup, whole: Recording):
    first = min(peaks(whole, setup).values())
    end = float(whole.time[-1])
    begins = np.arange(float(whole.time[0]), end - 0.005, 1e-3)
    passed = [begin for begin in begins if verdict(setup, cut(whole, float(begin), end)) == "pass"]
    assert passed
    assert max(passed) < first
