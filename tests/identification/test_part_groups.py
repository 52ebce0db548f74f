"""Groups by name, by id and by boxes: the same parts, and what does not fit is told with its place."""

from __future__ import annotations

import shutil
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from certkit.bench.extract_vehicle import extract
from certkit.definitions.loading.library import load
from certkit.errors import DefinitionError
from certkit.exchange.fe.histories import PartHistories, PartHistory
from certkit.exchange.fe.reading import read_case_data
from certkit.identification.grouping import build_graph
from certkit.identification.part_groups import GroupingError, left_over, part_groups

if TYPE_CHECKING:
    from certkit.definitions.extraction_case import Case

EXAMPLES = Path(__file__).parents[2] / "examples/extract"
BUMPER = EXAMPLES / "bumper-reference"
TIME = np.linspace(0.0, 0.01, 12)

FRONT_BOXES = {
    "F1": "x: [0 mm, 100 mm], z: [200 mm, 255 mm]",
    "F2": "x: [0 mm, 50 mm], z: [255 mm, 365 mm]",
    "F3": "x: [0 mm, 50 mm], z: [365 mm, 445 mm]",
    "F4": "x: [0 mm, 30 mm], z: [445 mm, 515 mm]",
    "F5": "x: [0 mm, 30 mm], z: [515 mm, 585 mm]",
    "F6": "x: [0 mm, 60 mm], z: [585 mm, 675 mm]",
    "F7": "x: [60 mm, 120 mm], z: [675 mm, 735 mm]",
    "H1": "x: [160 mm, 200 mm], z: [770 mm, 800 mm]",
    "H2": "x: [300 mm, 600 mm]",
    "E1": "x: [120 mm, 200 mm], z: [200 mm, 300 mm]",
    "E2": "x: [40 mm, 80 mm], z: [400 mm, 600 mm]",
    "E3": "x: [120 mm, 150 mm], z: [400 mm, 600 mm]",
    "E4": "x: [160 mm, 180 mm], z: [700 mm, 730 mm]",
    "E5": "x: [190 mm, 220 mm], z: [740 mm, 760 mm]",
}


@cache
def front() -> PartHistories:
    case = load("case", EXAMPLES / "front1/case.yaml").document
    return read_case_data(case.histories, EXAMPLES / "front1").histories


def with_boxes(folder: Path, **changed: str) -> Case:
    text = (EXAMPLES / "front1/case.yaml").read_text("utf-8")
    for name, box in {**FRONT_BOXES, **changed}.items():
        assert f'parts: ["{name}_*"]' in text
        text = text.replace(f'parts: ["{name}_*"]', f"boxes: [{{{box}}}]", 1)
    (folder / "case.yaml").write_text(text, "utf-8")
    return load("case", folder / "case.yaml").document


def test_a_front_grouped_by_boxes_is_the_one_grouped_by_names(tmp_path: Path) -> None:
    by_name = build_graph(load("case", EXAMPLES / "front1/case.yaml").document, front())
    assert build_graph(with_boxes(tmp_path), front()).groups == by_name.groups


def test_a_part_in_two_boxes_is_named_with_both(tmp_path: Path) -> None:
    case = with_boxes(tmp_path, F5="x: [0 mm, 80 mm], z: [440 mm, 585 mm]")
    with pytest.raises(GroupingError) as told:
        part_groups(case, front())
    said = [message for _, message in told.value.faults]
    assert any("`F4_bumper_centre` is in the groups `F4` (box 1) and `F5` (box 1)" in each for each in said)
    assert any("`E2_ea_foam` is in the groups `F5` (box 1) and `E2` (box 1)" in each for each in said)


@pytest.mark.parametrize(
    ("box", "said"),
    [
        ("x: [900 mm, 950 mm]", r"lies in this box; the nearest is `H2_hood_rear` \(x 450 mm, z 825 mm\)"),
        ("y: [0 mm, 50 mm]", "y of none is known: leave that axis out"),
    ],
)
def test_a_box_that_holds_nothing_says_what_is_near(tmp_path: Path, box: str, said: str) -> None:
    with pytest.raises(GroupingError, match=said):
        part_groups(with_boxes(tmp_path, H2=box), front())


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("ids: [4]", 'ids: ["4-1"]', r"case-boxes\.yaml:12:36: the range `4-1` ends before it begins"),
        ("ids: [4]", "ids: [four]", r"case-boxes\.yaml:12:36: `four` is no id and no range of ids"),
        (
            "ids: [4]",
            'ids: ["5-99"]',
            r"case-boxes\.yaml:12:36: group `impactor`: no part has an id of `5-99`",
        ),
        (
            "x: [-5 mm, 5 mm]",
            "x: [5 mm, -5 mm]",
            r"case-boxes\.yaml:14:38: `-5 mm` does not lie beyond `5 mm`",
        ),
        ("x: [-5 mm, 5 mm]", "x: [-5 mm]", r"case-boxes\.yaml:14:38: has 1 entries; write from and to"),
        ("x: [-5 mm, 5 mm]", "x: [-5, 5 mm]", r"case-boxes\.yaml:14:39: `-5` has no unit"),
        ("{x: [-5 mm, 5 mm], y: [-50 mm, 50 mm]}", "{}", r"case-boxes\.yaml:14:34: a box needs bounds along"),
        ("ids: [4]", "ids: []", r"case-boxes\.yaml:12:13: a group needs `parts`, `boxes` or `ids`"),
        (
            "ids: [3]",
            'ids: ["2-3"]',
            r"case-boxes\.yaml:15:35: part `fascia` is in the groups `fascia` \(box 1\)",
        ),
        (
            "moves with: [fascia_front_centre]",
            "moves with box: {x: [0 mm, 1 mm]}",
            r"case-boxes\.yaml:14:\d+: group `fascia`: .* does not tell where its nodes are",
        ),
        ("low: 400 mm", "moves with box: {x: [0 mm, 1 mm]}, low: 400 mm", "stands beside `moves with`"),
    ],
)
def test_what_is_wrong_with_a_group_is_told_with_file_line_and_column(
    tmp_path: Path, old: str, new: str, said: str
) -> None:
    for name in ("case-boxes.yaml", "time-history.T01.gz"):
        shutil.copy(BUMPER / name, tmp_path)
    case = tmp_path / "case-boxes.yaml"
    text = case.read_text("utf-8")
    assert old in text
    case.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(DefinitionError, match=said):
        extract(case, procedure=None)


def test_boxes_and_ids_give_the_numbers_that_names_give() -> None:
    by_place, by_name = (extract(BUMPER / f"{name}.yaml", procedure=None) for name in ("case-boxes", "case"))
    assert by_place.paths == by_name.paths
    assert by_place.groups == by_name.groups
    assert "part `foam` is in no group; its momentum changes by 1.5 % of the largest" in by_place.notes


def test_a_part_that_moves_much_and_is_in_no_group_is_warned_of() -> None:
    steady = np.ones_like(TIME)
    histories = PartHistories(
        TIME,
        {
            "ball": PartHistory(1.0, 10.0 - 1000 * TIME),
            "skin": PartHistory(1.0, 500 * TIME),
            "dust": PartHistory(0.1, 10 * TIME),
            "wall": PartHistory(9.0, 0 * steady),
        },
    )
    warnings, notes = left_over({"ball": ("ball",)}, histories, {})
    assert warnings == ["part `skin` is in no group; its momentum changes by 50.0 % of the largest"]
    assert notes == ["part `dust` is in no group; its momentum changes by 1.0 % of the largest"]


def test_a_group_moves_with_the_mean_of_the_nodes_in_a_box() -> None:
    from certkit.definitions.part_selection import Box  # noqa: PLC0415  # only here
    from certkit.identification.part_groups import nodes_in  # noqa: PLC0415  # only here

    places = {"low": (0.0, 0.0, 0.4), "high": (0.0, 0.1, 0.6), "far": (0.9, 0.0, 0.5)}
    nodes = dict.fromkeys(places, TIME)
    histories = PartHistories(TIME, {}, nodes=nodes, node_places=places)
    origin = {"source": "test", "confidence": "verified"}
    box = Box.model_validate({"origin": origin, "x": ["-1 mm", "1 mm"], "z": ["0.3 m", "0.7 m"]})
    assert nodes_in(box, histories, "skin") == ["low", "high"]
    empty = Box.model_validate({"origin": origin, "x": ["2 m", "3 m"]})
    with pytest.raises(GroupingError, match=r"no node lies in this box; the nearest is `far` \(x 900 mm"):
        nodes_in(empty, histories, "skin")
