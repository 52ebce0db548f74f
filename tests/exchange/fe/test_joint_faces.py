"""The face of a group of several parts: one line over all of them."""

from __future__ import annotations

import pytest

from certkit.exchange.fe.faces import Face, joint_face

LOWER = Face(mass=0.1, low=0.2, high=0.3, position=0.05, slope=0.4)
UPPER = Face(mass=0.2, low=0.3, high=0.5, position=0.10, slope=0.3)


def test_the_face_of_two_parts_runs_from_the_lower_end_of_one_to_the_upper_end_of_the_other() -> None:
    for order in ((LOWER, UPPER), (UPPER, LOWER)):
        face = joint_face(order)
        assert face is not None
        assert (face.low, face.high) == (0.2, 0.5)
        assert face.position == pytest.approx(0.5 * (0.03 + 0.13))
        assert face.slope == pytest.approx((0.13 - 0.03) / 0.3)


def test_a_part_without_a_face_adds_none() -> None:
    assert joint_face([LOWER, Face(mass=0.3)]) == LOWER
    assert joint_face([Face(mass=0.3)]) is None
    assert joint_face([]) is None
