"""Whoever writes a definition is told everything that is wrong with it at once, where, and what to do."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest

from certkit.definitions.loading.library import load
from certkit.definitions.loading.search_path import shipped_root
from certkit.errors import DefinitionError

if TYPE_CHECKING:
    from pathlib import Path

LEGFORM = shipped_root() / "models" / "legforms" / "flex-pli-gtr.yaml"
SOUND = """\
procedure: mine
title: My test
method: {document: Test sheet 7, confidence: verified}
rig:
  hinge: {at: tibia end, offset: 25 mm}
  added mass: {at: femur end, offset: 65 mm, mass: 5 kg}
criteria:
  - {id: T1, title: Tibia 1, channel: tibia moment 1, measure: max}
"""


def said(tmp_path: Path, text: str, kind: str = "procedure") -> list[str]:
    path = tmp_path / "mine.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(DefinitionError) as caught:
        load(kind, path)
    return [str(problem).replace(str(path), "mine.yaml") for problem in caught.value.problems]


def test_a_sound_procedure_has_no_problems(tmp_path: Path):
    path = tmp_path / "mine.yaml"
    path.write_text(SOUND, encoding="utf-8")
    assert load("procedure", path).name == "mine"


def test_five_different_mistakes_are_all_reported_with_their_places(tmp_path: Path):
    text = """\
procedure: mine
tittle: My test
method: {document: Test sheet 7, confidence: recaled}
rig:
  hinge: {at: tibia end, offset: 25}
  added mass: {at: femur end, offset: 65 N, mass: 5 kg}
criteria:
  - {id: T1, title: Tibia 1, channel: tibia moment 11, measure: max}
"""
    assert said(tmp_path, text) == [
        "mine.yaml:2:1: `tittle` is not known here; did you mean `title`?",
        "mine.yaml:3:46: `recaled` is not a choice; did you mean `recalled`?",
        "mine.yaml:5:34: `25` has no unit; a length is written in mm, cm, m, µm",
        "mine.yaml:6:39: `65 N` has the unit `N`; a length is written in mm, cm, m, µm",
        "mine.yaml:8:39: no channel is called `tibia moment 11`; did you mean `tibia moment 1`?",
    ]


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("title: My test\n", "", "1:1: `title` is missing; add it"),
        ("title: My test", "title: My test\ntitle: Again", "3:1: `title` stands here twice"),
        ("title: My test", "title: [My test]", "2:8: expected a word, not `['My test']`"),
        ("added mass:", "aded mass:", "6:3: `aded mass` is not known here; did you mean `added mass`?"),
        ("at: tibia end", "at: tibia", "5:15: `tibia` is no end of the leg; did you mean `tibia end`?"),
        (", mass: 5 kg", "", "6:15: `mass` is missing in `added mass`; add it"),
        ("mass: 5 kg", "mass: -5 kg", "`-5 kg` is negative; a mass is not"),
        ("mass: 5 kg", "mass: 0 kg", "a mass is greater than zero"),
        ("mass: 5 kg", "mass: {value: 5 kg, sauce: x}", "`sauce` is not known here; a number has value"),
        ("mass: 5 kg", "mass: {source: weighed, confidence: verified}", "`value` is missing"),
        (
            "mass: 5 kg",
            "mass: {value: 5 kg, confidence: sure}",
            "`sure` is no confidence; write one of verified",
        ),
        ("offset: 25 mm", "offset: no", "5:34: `no` is not a number with a unit"),
        ("offset: 25 mm", "offset: [25 mm]", "a length"),
        ("measure: max", "measure: maximum", "8:64: `maximum` is not a choice; did you mean `max`?"),
        ("measure: max", "measure: value at", "`value at` needs `at: {channel: …, equals: …}`"),
        ("measure: max", "measure: curve in polygon", "needs a `curve: {x: …, y: …}`"),
        ("channel: tibia moment 1, ", "", "`max` needs a `channel`"),
        ("measure: max", "measure: max, corridor: T1", "`T1` has to be written set/entry"),
        (
            "measure: max",
            "measure: value at, at: {channel: ram force, equals: 5 mm}",
            "`5 mm` has the unit `mm`; a force is written in N, kN, which is what ram force is",
        ),
        (
            "  added mass",
            "  hanger: {at: femur end}\n  added mass",
            "6:3: `hinge` and `hanger` cannot be on the same",
        ),
        (
            "  hinge: {at: tibia end, offset: 25 mm}",
            "  release: {angle: 15 deg}",
            "`release` does nothing without `hinge`",
        ),
        ("rig:", "specimen: {part: knee}\nrig:", "4:12: a knee alone needs `supports`"),
        ("rig:", "vehicle: some-car\nrig:", "4:1: a vehicle is hit in `free flight` only"),
        (
            "criteria:",
            "criteria:\n  - {id: T1, title: x, channel: T2, measure: min}",
            "`T1` is the id of a criterion already",
        ),
        ("criteria:", "criteria:\n  - 5", "8:5: expected keys with values, not `5`"),
        ("criteria:", "notes: none at all\ncriteria:", "expected a list such as [a, b], not `none at all`"),
        (
            "criteria:",
            "preconditions: [{quantity: a, dimension: lenth, within: [1 m, 2 m]}]\ncriteria:",
            "`lenth` is no dimension; did you mean `length`?",
        ),
        (
            "criteria:",
            "preconditions: [{quantity: a, dimension: length, within: [3 m, 2 m]}]\ncriteria:",
            "3 m lies above 2 m; exchange them",
        ),
        (
            "criteria:",
            "preconditions: [{quantity: a, dimension: length, within: [1 m]}]\ncriteria:",
            "needs at least 2 entries and has 1",
        ),
    ],
)
def test_a_mistake_is_one_sentence_at_its_place(tmp_path: Path, old: str, new: str, expected: str):
    assert old in SOUND
    found = said(tmp_path, SOUND.replace(old, new))
    assert len(found) == 1
    assert expected in found[0]


def test_a_misspelt_key_is_not_also_reported_as_missing(tmp_path: Path):
    assert len(said(tmp_path, SOUND.replace("title: My", "tittle: My"))) == 1


def test_a_broken_method_does_not_make_every_number_an_orphan(tmp_path: Path):
    found = said(tmp_path, SOUND.replace("{document: Test sheet 7, confidence: verified}", "{clause: 3}"))
    assert found == ["mine.yaml:3:9: `document` is missing in `method`; add it"]


def test_a_broken_origin_is_reported_once_and_not_at_every_number(tmp_path: Path):
    text = LEGFORM.read_text(encoding="utf-8")
    assert text.count("\n  confidence: ") == 2
    found = said(tmp_path, text.replace("\n  confidence: ", "\n  confidence: very ", 1), "legform")
    assert len(found) == 1
    assert "is not a choice; did you mean" in found[0]


def test_the_same_fixtures_word_may_not_come_in_two_spellings(tmp_path: Path):
    found = said(
        tmp_path,
        SOUND.replace("criteria:", "  added_mass: {at: femur end, offset: 1 mm, mass: 1 kg}\ncriteria:"),
    )
    assert any("added_mass" in problem for problem in found)


def test_problems_are_no_jargon(tmp_path: Path):
    text = "{procedure: [1], title: {a: 1}, method: 3, rig: 4, criteria: {}, notes: 3}"
    for problem in said(tmp_path, text):
        assert re.match(r"mine\.yaml:\d+:\d+: \S", problem)
        assert not re.search(
            r"pydantic|input should|validation error|dict|str\b|https?:|_type", problem.lower()
        )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("    LCL:", "    LLC:", "there is no ligament `LCL`"),
        ("part: femur", "part: femor", "there is no part `femor`; did you mean `femur`?"),
        ("{value: 297 mm", "{value: 597 mm", "is not on the femur, which reaches from 94 to 433 mm"),
        ("[femur, tibia]", "[tibia, femur]", "do not follow on each other in `parts`"),
        ("D0FEMRLO00PFMOX0", "D0FEMRLO00PFMOX", "is no code of 16 characters"),
        ("positive: [T1,", "positive: [T0,", "no channel is called `T0`"),
        ("    30 mm:", "    30 N·m:", "`30 N·m` has the unit `N·m`"),
        ("title: MCL elongation", "title: LCL elongation", "`LCL elongation` is said of two channels"),
        ("  knee shear:", "  ram force:", "`ram force` is a channel of the rig"),
    ],
)
def test_a_legforms_channels_ligaments_and_parts_have_to_go_together(
    tmp_path: Path, old: str, new: str, message: str
):
    text = LEGFORM.read_text(encoding="utf-8")
    assert old in text
    found = said(tmp_path, text.replace(old, new, 1), "legform")
    assert any(message in problem for problem in found), found


def test_a_vehicles_springs_lie_between_its_groups(tmp_path: Path):
    text = """\
vehicle: mine
title: A car
origin: {source: made up, confidence: estimated}
groups:
  bumper: {kind: fascia, mass: 1 kg, position: 0 mm, low: 0.4 m, high: 0.5 m}
springs:
  front: {between: [bumber, ground], loading: [[0 mm, 0 N], [10 mm, 1 kN]]}
  back: {between: [bumper, bumper], loading: [[0 mm, 0 N], [10 mm, 1 kg]]}
"""
    found = [problem.partition(": ")[2] for problem in said(tmp_path, text, "vehicle")]
    assert "there is no group `bumber`; did you mean `bumper`?" in found
    assert "both ends are `bumper`; a spring lies between two groups" in found
    assert "`1 kg` has the unit `kg`; a force is written in N, kN" in found


def test_published_values_stand_beside_measured_ones(tmp_path: Path):
    text = """\
reference: mine
title: Table
origin: {source: a table, confidence: verified}
values: {T1: 190 N·m, T2: 150 mm}
published: {T3: 90 N·m}
"""
    found = [problem.partition(": ")[2] for problem in said(tmp_path, text, "reference")]
    assert any(problem.startswith("`150 mm` has the unit `mm`; a moment is written in") for problem in found)
    assert "`T3` has no value to stand beside; known: T1, T2" in found
