"""Old forms of files and paths are read for one release, with a remark that gives the new form."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import certkit.bench
from certkit.definitions.loading.kinds import KINDS
from certkit.definitions.loading.library import find, load
from certkit.definitions.loading.lint import survey
from certkit.definitions.loading.overrides import overrides_from
from certkit.errors import OldFormWarning, UsageError

NEW = "springs.lower foam.loading.28 mm=1300 N"


def listed_springs(folder: Path) -> Path:
    """Write the saloon as it was written when springs had no names."""
    text = find(KINDS["vehicle"], "generic-saloon").data.decode()
    head, _, springs = text.partition("\nsprings:\n")
    old = re.sub(r"^  [^#{\n]+: \{between", "  - {between", springs, flags=re.MULTILINE)
    path = folder / "saloon.yaml"
    path.write_text(f"{head}\nconnections:\n{old}", "utf-8")
    return path


def test_a_spring_and_a_point_of_its_curve_are_named_in_a_path():
    loaded = load("vehicle", "generic-saloon", overrides=overrides_from([NEW]))
    assert [float(f) for _, f in loaded.document.springs["lower foam"].loading] == [0.0, 1300.0, 1620.0]
    assert (loaded.overrides[0].path, loaded.overrides[0].was) == (
        "springs.lower foam.loading.28 mm",
        "1204 N",
    )
    assert loaded.remarks == ()


@pytest.mark.parametrize("old", ["connections.3.loading.2.2", "springs.lower foam.loading.2.2"])
def test_a_position_in_a_list_is_an_old_path_to_the_same_value(old: str):
    new = load("vehicle", "generic-saloon", overrides=overrides_from([NEW]))
    with pytest.warns(OldFormWarning, match="old path"):
        by_position = load("vehicle", "generic-saloon", overrides={old: "1300 N"})
    assert by_position.document == new.document
    assert [change.path for change in by_position.overrides] == ["springs.lower foam.loading.28 mm"]
    assert "write `vehicle.springs.lower foam.loading" in by_position.remarks[-1]


def test_a_file_with_listed_springs_is_read_and_its_springs_are_named_by_their_ends(tmp_path: Path):
    with pytest.warns(OldFormWarning, match="`connections` is an old form"):
        old = load("vehicle", listed_springs(tmp_path))
    new = load("vehicle", "generic-saloon").document
    assert list(old.document.springs.values()) == list(new.springs.values())
    assert list(old.document.springs)[:2] == ["F1 to E1", "F2 to E1"]


def test_old_paths_fit_old_files(tmp_path: Path):
    with pytest.warns(OldFormWarning) as told:
        loaded = load("vehicle", listed_springs(tmp_path), overrides={"connections.3.damping": "70 N·s/m"})
    assert loaded.document.springs["F3 to E2"].damping == 70.0
    assert any("write `vehicle.springs.F3 to E2.damping`" in str(remark.message) for remark in told)


def test_a_fault_in_an_old_file_has_its_place(tmp_path: Path):
    path = listed_springs(tmp_path)
    path.write_text(path.read_text("utf-8").replace("[22 mm, 1540 N]", "[22 mm, 1540 kg]", 1), "utf-8")
    line = (
        path.read_text("utf-8")
        .split("\n")
        .index(next(r for r in path.read_text("utf-8").split("\n") if "1540 kg" in r))
        + 1
    )
    with pytest.warns(OldFormWarning):
        (problem,) = survey(path)[1]
    assert (problem.line, "1540 kg" in problem.message) == (line, True)


def test_an_unknown_path_is_answered_in_new_words():
    with pytest.raises(UsageError, match=r"did you mean `springs\.lower foam\.damping`"):
        load("vehicle", "generic-saloon", overrides={"springs.lower foam.dampening": "1 N·s/m"})


def test_a_result_notes_old_paths_and_shows_the_new_ones():
    change = "vehicle.connections.3.loading.2.2=1300 N"
    with pytest.warns(OldFormWarning):
        result = certkit.run(
            "vehicle", overrides=overrides_from(["vehicle=generic-saloon", change]), refine=False
        )
    assert [entry.path for entry in result.provenance.overrides][
        -1
    ] == "vehicle.springs.lower foam.loading.28 mm"
    assert any("is an old path" in note for note in result.notes)
