"""A file is looked over together with what it names."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from certkit.definitions.loading.cross_references import disagreements
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import find, load
from certkit.definitions.loading.lint import survey
from certkit.definitions.loading.overrides import overrides_from
from certkit.definitions.loading.yaml_reader import read_tree

if TYPE_CHECKING:
    from pathlib import Path

POLYGONS = """\
corridors: r127-static-knee
title: Made-up areas
origin: {source: made up for a test, confidence: estimated}
polygons:
  MCL-force: {x: ram force, y: MCL elongation, points: [[0 N, -1 mm], [5 kN, -1 mm], [5 kN, 40 mm]]}
  ACL-force: {x: ram force, y: ACL elongation, points: [[0 N, -1 mm], [5 kN, -1 mm], [5 kN, 40 mm]]}
  PCL-force: {x: ram force, y: MCL elongation, points: [[0 N, -1 mm], [5 kN, -1 mm], [5 kN, 40 mm]]}
"""


def against(*overrides: str, library: tuple[Path, ...] = (), name: str = "pendulum") -> list[str]:
    found = find(KINDS["procedure"], name)
    tree = read_tree(found.data, found.file)
    document = load("procedure", name, overrides=overrides_from(overrides)).document
    return [problem.message for problem in disagreements(document, tree, library)]


@pytest.mark.parametrize(
    ("override", "expected"),
    [
        (
            "criteria.T1.corridor=r127-pendulun/T1",
            "there is no corridor set `r127-pendulun`; did you mean `r127-pendulum`?",
        ),
        (
            "criteria.T1.corridor=r127-pendulum/T11",
            "the set `r127-pendulum` has no `T11`; did you mean `T1`?",
        ),
        (
            "criteria.T1.corridor=r127-pendulum/MCL",
            "does not fit the criterion's channel: `20.5 mm` has the unit `mm`",
        ),
        ("criteria.T1.measure=time of max", "a time is written in s, ms"),
        ("score=r127-pendulum", "the set `r127-pendulum` has no scores"),
        ("score=euro-ncap-2026", "is for the aPLI, not for the Flex-PLI"),
        ("reference=seed-table", "there is no reference `seed-table`; did you mean `seed-table-1`?"),
        ("specimen.legform=flex-pli", "there is no legform `flex-pli`; did you mean `flex-pli-gtr`?"),
    ],
)
def test_what_a_procedure_names_has_to_exist_and_fit(override: str, expected: str):
    assert expected in " ".join(against(override))


def test_a_sound_procedure_disagrees_with_nothing():
    assert against() == []


def test_a_polygon_has_to_have_the_curves_axes(tmp_path: Path):
    (tmp_path / "r127-static-knee.yaml").write_text(POLYGONS, encoding="utf-8")
    assert against(library=(tmp_path,), name="static-knee") == [
        "has MCL elongation on its y axis; the criterion's curve has another channel there"
    ]


def test_a_curve_is_not_held_against_a_window():
    (problem,) = against("criteria.moment-deflection.corridor=r127-pendulum/T1", name="static-femur")
    assert problem == "is a window, but `curve in polygon` is held against a polygon"


def test_what_a_file_names_may_lie_beside_it(tmp_path: Path):
    text = find(KINDS["procedure"], "pendulum").data.decode()
    text = text.replace("r127-pendulum/", "ours/").replace("procedure: pendulum", "procedure: ours")
    (tmp_path / "mine.yaml").write_text(text, encoding="utf-8")
    assert len(survey(tmp_path / "mine.yaml")[1]) == 7
    corridors = find(KINDS["corridors"], "r127-pendulum").data.decode().replace("r127-pendulum", "ours")
    (tmp_path / "ours.yaml").write_text(corridors, encoding="utf-8")
    assert survey(tmp_path / "mine.yaml")[1] == []


def test_a_file_of_no_kind_is_told_the_kinds(tmp_path: Path):
    (tmp_path / "odd.yaml").write_text("procdure: x\n", encoding="utf-8")
    (problem,) = survey(tmp_path / "odd.yaml")[1]
    assert problem.message == "`procdure` is no kind of definition; did you mean `procedure`?"


def test_a_missing_file_is_a_problem_like_any_other(tmp_path: Path):
    (problem,) = survey(tmp_path / "nowhere.yaml")[1]
    assert problem.message == "does not exist"


def test_a_bone_whose_mass_cannot_be_spread_is_found_before_it_runs(tmp_path: Path):
    text = (
        find(KINDS["legform"], "apli").data.decode().replace("inertia: 0.0325 kg·m²", "inertia: 0.01 kg·m²")
    )
    (tmp_path / "ours.yaml").write_text(text, encoding="utf-8")
    (problem,) = survey(tmp_path / "ours.yaml")[1]
    assert text.splitlines()[problem.line - 1].strip().startswith("inertia: 0.01")
    assert problem.message.startswith(
        "femur: with its mass, size and centre of gravity its inertia has to be from"
    )
