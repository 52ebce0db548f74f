"""Corridors have an order, a shape and an origin, or are refused."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from certkit.definitions.corridor_set import CorridorSet
from certkit.definitions.loading.validation import validate
from certkit.definitions.loading.yaml_reader import read_tree
from certkit.definitions.polygon import crossing
from certkit.errors import DefinitionError

HEAD = "corridors: mine\ntitle: Mine\norigin: {source: my handbook, confidence: verified}\n"


def read(text: str) -> CorridorSet:
    return validate(read_tree(HEAD + text, "mine.yaml"), CorridorSet)


def said(text: str) -> list[str]:
    with pytest.raises(DefinitionError) as caught:
        read(text)
    return [str(problem) for problem in caught.value.problems]


def test_an_entry_has_the_sets_origin_or_its_own():
    corridors = read(
        "windows:\n  T1: {upper: 1 N·m}\n  T2: {upper: 1 N·m, source: elsewhere, confidence: recalled}\n"
    )
    assert corridors.windows["T1"].source == "my handbook"
    assert (corridors.windows["T2"].source, corridors.windows["T2"].confidence) == ("elsewhere", "recalled")


def test_an_entry_without_any_origin_is_refused():
    with pytest.raises(DefinitionError, match="`source` is missing"):
        validate(read_tree("corridors: x\ntitle: X\nwindows: {T1: {upper: 1 mm}}", "x.yaml"), CorridorSet)


def test_an_awaited_corridor_is_known_and_not_there():
    corridors = read("awaited: {MCL: not found}\nwindows: {T1: {upper: 1 N·m}}")
    assert corridors.entry("MCL") is None
    assert corridors.entry("T1") is corridors.windows["T1"]
    with pytest.raises(KeyError):
        corridors.entry("T2")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("", "1:1: holds no corridor"),
        ("windows: {T1: {}}", "has neither `lower` nor `upper`"),
        (
            "windows: {T1: {lower: 2 N·m, upper: 1 N·m}}",
            "4:23: lower 2 N·m lies above upper 1 N·m; exchange them",
        ),
        (
            "windows: {T1: {lower: 2 mm, upper: 3 N·m}}",
            "4:36: `3 N·m` is another kind of quantity than the length",
        ),
        (
            "windows: {T1: {upper: 3}, T2: {upper: 3 N}, T3: {upper: three}}",
            "`three` is not a number with a unit",
        ),
        ("windows: {a: {upper: 3 N}}\nawaited: {a: soon}", "5:14: `a` stands under `windows` already"),
        ("polygons: {a: {x: T1, y: T2, points: [[0 m, 0 m], [1 m, 1 m]]}}", "at least 3 entries"),
        (
            "polygons: {a: {x: T1, y: T2, points: [[0 m, 0 N], [1 m, 1 N], [1 m, 0 N], [0 m, 1 N]]}}",
            "the side from point 1 meets the side from point 3; give the corners in turn",
        ),
        (
            "polygons: {a: {x: T1, y: T2, points: [[0 m, 0 N], [1 m, 1 N], [1 N, 0 N]]}}",
            "`1 N` is another kind of quantity than the length",
        ),
        ("bands: {a: {}}", "has neither `lower` nor `upper`"),
        ("bands: {a: {lower: [[1 m, 1 N], [2 m, 1 N]]}}", "`1 m` is no time"),
        ("bands: {a: {lower: [[1 ms, 1 N], [0 s, 1 N]]}}", "4:35: the times of a band have to increase"),
        (
            "scores: {a: {criteria: [T1], full: 3 N·m, zero: 2 N·m, points: 1}}",
            "full 3 N·m lies above zero 2 N·m",
        ),
        (
            "scores: {a: {criteria: [], full: 1 m, zero: 2 m, points: 1}}",
            "needs at least 1 entries and has 0",
        ),
        ("scores: {a: {criteria: [T1], full: 1 m, zero: 2 m, points: 0}}", "`0` has to be greater than 0"),
        (
            "scores: {a: {criteria: [T1], full: 1 m, zero: 2 m, points: 1, forfeit: {criteria: [x], at: x}}}",
            "`x` is not a number with a unit",
        ),
    ],
)
def test_a_corridor_that_makes_no_sense_is_refused_where_it_stands(text: str, expected: str):
    (problem,) = said(text)
    assert expected in problem


def test_a_user_can_supply_a_polygon_band_and_score():
    corridors = read(
        "polygons:\n"
        "  MCL-force: {x: ram force, y: MCL elongation, points: [[0 N, -1 mm], [4 kN, 9 mm], [0 N, 30 mm]]}\n"
        "bands: {T1: {upper: [[0 ms, 10 N·m], [0.1 s, 0.3 kN·m]]}}\n"
        "scores: {tibia: {criteria: [T1], full: 282 N·m, zero: 340 N·m, points: 0.5}}\n"
    )
    assert corridors.entries == ["MCL-force", "T1"]


@given(st.integers(3, 12), st.floats(0.1, 3.0), st.integers(0, 11))
def test_a_star_shaped_polygon_is_simple_and_an_exchange_of_corners_is_not(
    corners: int, angle: float, start: int
):
    points = [
        (math.cos(angle + 2 * math.pi * i / corners), math.sin(angle + 2 * math.pi * i / corners))
        for i in range(corners)
    ]
    assert crossing(points) is None
    assert crossing([*points, points[0]]) is None
    if corners >= 4:
        i, j = start % corners, (start + 1) % corners
        points[i], points[j] = points[j], points[i]
        assert crossing(points) is not None


def test_a_polygon_folded_onto_itself_is_not_simple():
    assert crossing([(0, 0), (2, 0), (1, 0)]) is not None
    assert crossing([(0, 0), (1, 0), (2, 0), (1, 1)]) is None
    assert crossing([(0, 0), (2, 0), (2, 2), (1, 0), (0, 2)]) is not None  # touches its own side


def test_a_set_may_hold_nothing_but_what_it_awaits():
    assert read("awaited: {MCL: not found}").entries == ["MCL"]
