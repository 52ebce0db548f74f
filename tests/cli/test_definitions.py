"""`list`, `show`, `validate` and `schema` through the real command."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

Command = Callable[..., subprocess.CompletedProcess[str]]

WRONG = """\
procedure: mine
tittle: My test
method: {document: Test sheet 7, confidence: recaled}
rig:
  hinge: {at: tibia end, offset: 25}
criteria:
  - {id: T1, title: Tibia 1, channel: tibia moment 11, measure: max}
"""


def test_the_list_has_a_line_a_definition_when_piped(certkit: Command):
    lines = certkit("list").stdout.splitlines()
    assert "procedure\tpendulum\tDynamic certification, pendulum test\tprocedures/pendulum.yaml" in lines
    assert all(line.count("\t") == 3 for line in lines)


def test_the_list_can_be_of_one_kind_and_in_json(certkit: Command):
    listed = json.loads(certkit("list", "corridors", "--json").stdout)
    assert {entry["kind"] for entry in listed} == {"corridors"}
    assert "r127-pendulum" in {entry["name"] for entry in listed}


def test_an_unknown_kind_is_a_usage_error(certkit: Command):
    done = certkit("list", "procdure")
    assert done.returncode == 2
    assert "did you mean `procedure`?" in done.stderr


def test_ones_own_definitions_are_listed_instead_of_shipped_ones(certkit: Command, tmp_path: Path):
    text = certkit("show", "pendulum", "--json").stdout
    assert json.loads(text)["document"]["title"].startswith("Dynamic")
    (tmp_path / "lab" / "procedures").mkdir(parents=True)
    (tmp_path / "lab" / "procedures" / "pendulum.yaml").write_text("procedure: pendulum\ntitle: Ours\n")
    lines = certkit("list", "procedure", "--library", "lab").stdout.splitlines()
    assert "procedure\tpendulum\tOurs\tlab/procedures/pendulum.yaml" in lines


def test_show_prints_the_file_itself_to_begin_from(certkit: Command, tmp_path: Path):
    (tmp_path / "ours.yaml").write_text(certkit("show", "flex-pli-gtr", "--file").stdout, "utf-8")
    assert "\nlegform: flex-pli-gtr\n" in (tmp_path / "ours.yaml").read_text("utf-8")
    assert certkit("validate", "ours.yaml").returncode == 0


def test_show_tells_each_numbers_origin_and_each_criterions_corridor(certkit: Command):
    shown = certkit("show", "pendulum").stdout
    assert "T1\tmax of tibia moment 1, CFC 180\t235 N·m to 272 N·m\tverified\tUN R127" in shown
    assert "rig.added mass.mass\t5 kg\tsecondary\tseed paper" in shown


def test_show_finds_a_corridor_set_and_a_legform_by_name_alone(certkit: Command):
    assert "MCL-force\t" in certkit("show", "r127-static-knee").stdout
    assert "parts.femur.mass\t2.46 kg\tverified" in certkit("show", "flex-pli-gtr").stdout


def test_show_lays_changes_open(certkit: Command):
    shown = certkit("show", "inverse", "--set", "rig.ram.speed=11.3 m/s").stdout
    assert "changed: rig.ram.speed = 11.3 m/s (was 11.1 m/s)" in shown
    assert "rig.ram.speed\t11.3 m/s\testimated\tset on the command line" in shown


def test_validate_reports_every_problem_of_every_file_and_exits_with_2(certkit: Command, tmp_path: Path):
    (tmp_path / "wrong.yaml").write_text(WRONG)
    (tmp_path / "broken.yaml").write_text("a: [")
    done = certkit("validate", "wrong.yaml", "broken.yaml")
    assert done.returncode == 2
    places = [line.split(": ")[1] for line in done.stderr.splitlines()]
    assert places == [
        "broken.yaml:2:1",
        "wrong.yaml:2:1",
        "wrong.yaml:3:46",
        "wrong.yaml:5:34",
        "wrong.yaml:7:39",
    ]
    assert done.stdout == ""


def test_validate_can_speak_to_programs(certkit: Command, tmp_path: Path):
    (tmp_path / "wrong.yaml").write_text(WRONG)
    done = certkit("validate", "wrong.yaml", "--json")
    assert done.returncode == 2
    assert [(problem["line"], problem["column"]) for problem in json.loads(done.stdout)] == [
        (2, 1),
        (3, 46),
        (5, 34),
        (7, 39),
    ]


def test_validate_says_which_files_are_sound(certkit: Command, tmp_path: Path):
    text = certkit("show", "r127-pendulum", "--json").stdout
    for name in ("r127-pendulum", "sound"):  # JSON is YAML too
        (tmp_path / f"{name}.yaml").write_text(json.dumps(json.loads(text)["document"]))
    done = certkit("validate", "r127-pendulum.yaml", "sound.yaml")
    assert done.returncode == 0
    assert done.stdout.splitlines() == [
        "r127-pendulum.yaml: ok",
        "sound.yaml: ok; to be found by its name, its file has to be called `r127-pendulum.yaml`",
    ]


def test_everything_shipped_is_sound(certkit: Command):
    done = certkit("validate", "--all")
    assert done.stderr == ""
    assert done.returncode == 0


@pytest.mark.parametrize("arguments", [(), ("--all", "x.yaml")])
def test_validate_wants_files_or_all(certkit: Command, arguments: tuple[str, ...]):
    done = certkit("validate", *arguments)
    assert done.returncode == 2
    assert "name the files to check, or use --all" in done.stderr


@pytest.mark.parametrize(
    "kind", ["procedure", "corridors", "legform", "vehicle", "reference", "laboratory", "result"]
)
def test_a_schema_is_printed_as_json(certkit: Command, kind: str):
    schema = json.loads(certkit("schema", kind).stdout)
    assert schema["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert schema["properties"]


def test_a_name_or_a_file_of_another_kind_is_told_as_that(certkit: Command, tmp_path: Path):
    named = certkit("run", "generic-saloon")
    assert named.returncode == 2
    assert "`generic-saloon` is a vehicle, no procedure" in named.stderr
    (tmp_path / "car.yaml").write_text(certkit("show", "generic-saloon", "--file").stdout)
    given = certkit("run", "car.yaml")
    assert (given.returncode, len(given.stderr.splitlines())) == (2, 1)
    assert "car.yaml:2:1: this is a vehicle, no procedure; name the file of a procedure" in given.stderr
