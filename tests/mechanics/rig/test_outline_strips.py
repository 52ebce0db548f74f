"""Strips of folding faces: where two outlines go over into each other, a load is on both groups."""

from __future__ import annotations

import pytest

from certkit.definitions.loading.library import load
from certkit.mechanics.rig.face_outlines import outline_strips


def test_a_load_between_the_nodes_of_two_faces_is_on_both_by_lever_and_on_none_but_one_elsewhere() -> None:
    vehicle = load("vehicle", "fe-front").document
    (_, below), (_, edge) = vehicle.groups["F4"].outlines[0].points[-2:]
    for strip in outline_strips(vehicle, 0.0):
        height = strip.start[1]
        if strip.group == "F4" and height > below:
            assert strip.partner == "F5"
            assert strip.share == pytest.approx((height - below) / (edge - below))
        elif strip.group in {"F4", "F5"} and height < 0.55:
            assert (strip.partner, strip.share) == (strip.group, 0.0)
