"""Which nodes tell how a leg's axis moved."""

from __future__ import annotations

import numpy as np

from certkit.bench.contact_check import leg_nodes
from certkit.exchange.fe.node_motion import NodeMotion

TIME = np.array([0.0, 0.001, 0.002])


def motion(heights: dict[str, float]) -> NodeMotion:
    return NodeMotion(TIME, {line: {line: np.full((3, 2), z)} for line, z in heights.items()})


def test_nodes_of_axis_and_knee_come_from_below() -> None:
    nodes = leg_nodes(motion({"leg_axis_2": 0.7, "leg_knee_block": 0.6, "leg_axis_1": 0.5, "F1": 0.4}))
    assert nodes is not None
    assert nodes[:, 0, 1].tolist() == [0.5, 0.6, 0.7]


def test_nodes_that_lie_on_one_another_count_once() -> None:
    """Two of them make no line, and where axis and knee meet there often are two."""
    nodes = leg_nodes(motion({"leg_axis_1": 0.5, "leg_knee_block": 0.6, "leg_axis_2": 0.6}))
    assert nodes is not None
    assert nodes[:, 0, 1].tolist() == [0.5, 0.6]


def test_a_run_without_them_tells_nothing_of_the_axis() -> None:
    assert leg_nodes(None) is None
    assert leg_nodes(motion({"F1": 0.4, "F2": 0.5})) is None
