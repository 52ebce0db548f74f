"""Outlines of a folding face: between them straight lines give the face as it moved."""

from __future__ import annotations

import numpy as np
import pytest

from certkit.exchange.fe.node_motion import NodeMotion
from certkit.identification.folding_outlines import TOLERANCE, FoldingOutlines, folding_outlines
from certkit.identification.grouping import Graph
from certkit.identification.sampling import Grid

TIME = np.linspace(0.0, 0.04, 401)
MOVED = 0.08 * np.sin(np.pi * TIME / 0.04)


def outlines_of(bulge: np.ndarray, moved: np.ndarray = MOVED) -> FoldingOutlines:
    """Return the outlines of a face of three nodes, whose middle one stands out by `bulge` (m)."""
    places = {
        f"node {k}": np.column_stack([moved - (bulge if k == 1 else 0.0), np.full_like(TIME, 0.1 * k)])
        for k in range(3)
    }
    graph = Graph({"F1": ("part",)}, ())
    motion = NodeMotion(TIME, {"part": places})
    return folding_outlines(graph, {"F1": "fascia"}, motion, {"F1": moved}, Grid(TIME, TIME, 1e-3))["F1"]


def test_a_fold_that_opens_at_once_is_kept_where_a_stiff_face_needs_two_outlines() -> None:
    fold = 0.02 / (1.0 + np.exp(-(TIME - 0.012) / 3e-4))
    found = outlines_of(fold)
    way = np.flatnonzero(TIME <= 0.02)
    bulge = np.interp(MOVED[way], found.at, found.at - found.pushed[:, 1, 0])
    # A step of the outlines' places, 2 % of the travel, is crossed while the fold opens.
    assert np.abs(bulge - fold[way]).max() < 0.004
    assert np.sqrt(np.mean((bulge - fold[way]) ** 2)) < 2 * TOLERANCE
    assert 4 < len(found.at) < 40
    assert len(outlines_of(0.0 * TIME).at) == 2


def test_a_face_that_goes_on_to_fold_while_its_group_stands_still_has_the_mean_of_its_forms_there() -> None:
    moved = 0.08 * np.interp(TIME, [0.0, 0.010, 0.022, 0.030, 0.040], [0.0, 0.6, 0.6, 1.0, 0.0])
    there = (TIME >= 0.010) & (TIME <= 0.022)
    fold = np.where(there, 0.01 * np.sin(np.pi * (TIME - 0.010) / 0.012), 0.0)
    found = outlines_of(fold, moved)
    bulge = np.interp(moved[there], found.at, found.at - found.pushed[:, 1, 0])
    assert bulge.mean() == pytest.approx(fold[there].mean(), rel=0.1)
    assert np.interp(0.3 * 0.08, found.at, found.at - found.pushed[:, 1, 0]) == pytest.approx(
        0, abs=TOLERANCE
    )


def test_a_face_that_hardly_moves_is_told_no_more_finely_than_the_others() -> None:
    """What it does while it stands still is no jump over a hair's breadth of displacement."""
    turning = 0.004 * np.sin(2 * np.pi * TIME / 0.008)
    moved = {"F1": MOVED, "H1": 0.1 * MOVED}
    places = {
        name: {
            f"{name} {k}": np.column_stack([moved[name] - k * turning, np.full_like(TIME, z + 0.1 * k)])
            for k in range(2)
        }
        for name, z in (("F1", 0.0), ("H1", 0.5))
    }
    graph = Graph({name: (name,) for name in places}, ())
    kinds = {"F1": "fascia", "H1": "hood"}
    found = folding_outlines(graph, kinds, NodeMotion(TIME, places), moved, Grid(TIME, TIME, 1e-3))
    for name, face in found.items():
        assert np.diff(face.at)[:-1].min() >= 0.02 * MOVED.max(), name
        assert len(face.at) > 2


def test_what_a_face_does_after_it_has_come_back_is_no_part_of_its_way_back() -> None:
    moved = 0.08 * np.interp(TIME, [0.0, 0.010, 0.020, 0.030, 0.040], [0.0, 1.0, 0.0, 0.6, 0.0])
    later = outlines_of(np.where(TIME > 0.020, 0.02, 0.0), moved)
    still = outlines_of(np.zeros_like(TIME), moved)
    assert later.shares == pytest.approx(still.shares)
    assert later.returning == pytest.approx(still.returning)


def test_outlines_stand_in_rising_order_though_the_group_comes_back_beyond_its_place_at_rest() -> None:
    moved = np.where(TIME < 0.03, MOVED, -0.5 * np.abs(MOVED))
    found = outlines_of(0.01 * np.sin(2e3 * TIME), moved)
    assert np.all(np.diff(found.at) > 0)
    assert np.all(np.diff(found.shares) > 0)
    assert found.shares.min(initial=1.0) >= 0
    assert found.shares.max(initial=0.0) < 1


def test_a_face_leads_on_to_the_next_of_its_sheet_whatever_lies_nearer_to_it() -> None:
    """Behind a spoiler lies its stiffener, above a grille the hood's edge: nearer, and other sheets."""
    places = {
        "lower": [(0.0, 0.1), (0.0, 0.2)],
        "upper": [(0.0, 0.3), (0.0, 0.4)],
        "stiffener": [(0.05, 0.21), (0.05, 0.24)],
        "hood": [(0.05, 0.41), (0.2, 0.45)],
    }
    still = {
        part: {f"{part} {k}": np.tile(place, (TIME.size, 1)) for k, place in enumerate(nodes)}
        for part, nodes in places.items()
    }
    kinds = {"lower": "fascia", "upper": "fascia", "stiffener": "engine room", "hood": "hood"}
    graph = Graph({name: (name,) for name in kinds}, ())
    moved = dict.fromkeys(kinds, 0.0 * TIME)
    found = folding_outlines(graph, kinds, NodeMotion(TIME, still), moved, Grid(TIME, TIME, 1e-3))
    assert found["lower"].pushed[0, -1] == pytest.approx(places["upper"][0])
    assert found["upper"].pushed[0, -1] == pytest.approx(places["upper"][1])
