"""How a loading curve goes on beyond what was seen of it."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.identification.curve_points import continued
from certkit.identification.spring_law import Branch, SpringLaw


def slope_beyond(law: SpringLaw) -> float:
    end = max(law.shortening)
    near, far = continued(law).loading(np.array([1.1, 2.0]) * end)
    return float((far - near) / (0.9 * end))


def test_a_spring_that_softened_comes_to_an_end_with_its_steepest_secant() -> None:
    law = SpringLaw((0.0, 0.01, 0.02), (0.0, 1000.0, 400.0), Branch(5e5))
    assert slope_beyond(law) == pytest.approx(1e5)
    assert continued(law).shortening[-1] == pytest.approx(1.5 * 0.02)


def test_no_spring_is_stiffer_beyond_what_was_seen_than_where_it_unloads() -> None:
    """A first blow of 1.5 kN within a millimetre says nothing of a contact that goes on for 17 mm."""
    places, forces = (0.0, 0.001, 0.003, 0.014, 0.018), (0.0, 1500.0, 200.0, 1500.0, 1000.0)
    law = SpringLaw(places, forces, Branch(1.2e5))
    assert slope_beyond(law) == pytest.approx(1.2e5)


def test_the_pulling_side_goes_on_alike() -> None:
    law = SpringLaw((-0.02, -0.01, 0.0, 0.01), (-400.0, -1000.0, 0.0, 100.0), Branch(5e4), tension=True)
    near, far = continued(law).pulling(np.array([0.022, 0.04]))
    assert (far - near) / 0.018 == pytest.approx(5e4)
