"""What a bad rating is told to come from."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.signals.iso18571 import LARGEST_SHIFT, rate
from certkit.signals.rating_causes import rating_causes

TIME = np.arange(0.0, 0.1, 1e-4)


def pulse(at: float) -> np.ndarray:
    return np.exp(-(((TIME - at) / 0.008) ** 2))


@pytest.mark.parametrize(("late", "code"), [(0.012, "curve-late"), (0.03, "curve-late-or-more")])
def test_a_shift_at_the_end_of_what_is_tried_is_told_as_that_or_more(late: float, code: str) -> None:
    reference, signal = pulse(0.04), pulse(0.04 + late)
    causes = rating_causes(reference, signal, rate(reference, signal))
    assert causes[0].code == code
    largest = LARGEST_SHIFT * TIME.size * 0.1
    assert causes[0].parameters["by"] == pytest.approx(min(late * 1e3, largest), abs=0.2)
