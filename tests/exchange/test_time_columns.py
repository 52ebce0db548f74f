"""A time column is one of equal steps, or is refused with the line of its first odd one."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.errors import DataError
from certkit.exchange.timebase import base_of_times

TIME = np.arange(0, 400) * 1e-4


def test_rounding_in_a_written_time_is_no_odd_step():
    times = TIME + 0.19e-4 * (np.arange(TIME.size) == 200)
    base = base_of_times(times, "leg.csv", 3)
    assert base.times() == pytest.approx(TIME, abs=1e-9)


def test_a_step_that_is_off_by_a_fifth_is_refused_with_its_line():
    times = TIME + 0.21e-4 * (np.arange(TIME.size) == 200)
    with pytest.raises(DataError, match=r"leg\.csv:203: the sampling is not uniform"):
        base_of_times(times, "leg.csv", 3)


def test_a_lost_sample_is_refused():
    with pytest.raises(DataError, match="the sampling is not uniform"):
        base_of_times(np.delete(TIME, 200), "leg.csv", 3)
