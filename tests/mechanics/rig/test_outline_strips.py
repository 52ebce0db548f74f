"""Strips of folding faces: where two outlines go over into each other, a load is on both groups."""

from __future__ import annotations

import pytest

from certkit.definitions.loading.library import load
from certkit.mechanics.rig.face_outlines import outline_strips


def test_a_strip_at_the_edge_of_two_faces_shares_its_load_by_half_and_one_in_the_middle_with_none() -> None:
    vehicle = load("vehicle", "fe-front").document
    strips = [strip for strip in outline_strips(vehicle, 0.0) if strip.group in ("F4", "F5")]
    edge = 0.515  # m above the ground
    shares = {strip.start[1]: (strip.group, strip.partner, strip.share) for strip in strips}
    nearest = sorted(shares, key=lambda z: abs(z - edge))[:2]
    assert {shares[z][:2] for z in nearest} == {("F4", "F5"), ("F5", "F4")}
    assert all(0.3 < shares[z][2] < 0.5 for z in nearest)
    assert shares[min(shares, key=lambda z: abs(z - 0.48))][2] == pytest.approx(0.0)
    assert all(0.0 <= share < 0.5 for _, _, share in shares.values())
