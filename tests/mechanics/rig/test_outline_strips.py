"""Strips of folding faces: where two outlines go over into each other, a load is on both groups."""

from __future__ import annotations

import pytest

from certkit.bench.setup import prepare
from certkit.definitions.loading.library import load
from certkit.mechanics.rig.face_outlines import outline_strips
from certkit.mechanics.simulate import build


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


@pytest.mark.parametrize("longest", [0.004, 0.02])
def test_strips_are_as_long_as_the_leg_is_met_in_and_cover_the_same_faces(longest: float) -> None:
    vehicle = load("vehicle", "fe-front").document
    strips = outline_strips(vehicle, 0.0, longest)
    heights = [strip.pushed[0, 2] for strip in strips]
    assert max(heights) <= longest + 1e-9
    assert max(heights) > 0.8 * longest
    assert sum(heights) == pytest.approx(sum(strip.pushed[0, 2] for strip in outline_strips(vehicle, 0.0)))


def test_a_leg_whose_foam_has_elements_is_met_in_strips_as_long() -> None:
    numbers = []
    for element in ("20 mm", "5 mm"):
        setup = prepare("vehicle-fe-front", overrides={"legform.flesh.foam.element": element})
        front = build(setup.procedure, setup.legform, setup.vehicle).front
        assert front is not None
        numbers.append(len(front.folding))
    assert numbers[1] > 2 * numbers[0]
