"""What a run leaves behind, and what it says on which stream."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest
from support.command import Command

FILES = {"result.json", "channels.csv", "report.html", "report.pdf", "junit.xml"}
PROCEDURES = (
    "inverse",
    "inverse-seed",
    "pendulum",
    "static-femur",
    "static-knee",
    "static-tibia",
    "vehicle",
)
CLOCK = ("solver_seconds",)


def _without_clock(text: str) -> object:
    document = json.loads(text)
    if document["quality"]:
        for field in CLOCK:
            document["quality"].pop(field)
    return document


@pytest.mark.pdf
@pytest.mark.slow
def test_all_procedures_write_every_file_of_the_contract_twice_the_same(
    certkit: Command, tmp_path: Path
) -> None:
    first = certkit("run", "--all", "--out", "one")
    # The made-up saloon strains the MCL too far; nothing is wrong with the runs.
    assert first.returncode == 1, first.stdout + first.stderr
    schema = json.loads(certkit("schema", "result").stdout)
    for name in PROCEDURES:
        folder = tmp_path / "one" / name
        assert {path.name for path in folder.iterdir()} >= FILES
        jsonschema.validate(json.loads((folder / "result.json").read_text("utf-8")), schema)
    certkit("run", "--all", "--out", "two")
    for name in PROCEDURES:
        one, two = tmp_path / "one" / name, tmp_path / "two" / name
        assert _without_clock((one / "result.json").read_text("utf-8")) == _without_clock(
            (two / "result.json").read_text("utf-8")
        )
        assert (one / "channels.csv").read_bytes() == (two / "channels.csv").read_bytes()
        assert (one / "junit.xml").read_bytes() == (two / "junit.xml").read_bytes()


def test_standard_output_is_the_document_alone_with_json(certkit: Command, tmp_path: Path) -> None:
    done = certkit("run", "--procedure", "static-tibia", "--json", "--format", "junit")
    assert json.loads(done.stdout)["schema"] == "certkit-result/1"
    assert (tmp_path / "runs" / "static-tibia" / "result.json").read_text("utf-8") == done.stdout


@pytest.mark.pdf
def test_a_report_is_rendered_again_from_the_json_alone(certkit: Command, tmp_path: Path) -> None:
    certkit("run", "--procedure", "static-tibia", "--out", "first")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "result.json").write_bytes((tmp_path / "first" / "result.json").read_bytes())
    assert certkit("report", "elsewhere/result.json", "--out", "again").returncode == 0
    for name in ("report.html", "report.pdf"):
        assert (tmp_path / "first" / name).read_bytes() == (tmp_path / "again" / name).read_bytes()


def test_colour_is_left_out_when_piped(certkit: Command) -> None:
    assert "\x1b" not in certkit("run", "--procedure", "static-tibia", "--format", "junit").stdout


def test_failures_become_annotations_on_github(certkit: Command) -> None:
    done = certkit(
        "run", "-p", "inverse", "--set", "rig.ram.speed=13 m/s", "--format", "junit", GITHUB_ACTIONS="true"
    )
    assert "::error" in done.stdout


def test_procedures_are_named_by_position_or_by_option(certkit: Command, tmp_path: Path) -> None:
    run = certkit("run", "static-femur", "--procedure", "static-tibia", "--format", "junit", "--out", "both")
    assert run.returncode == 4, run.stderr
    assert {path.name for path in (tmp_path / "both").iterdir()} >= {"static-femur", "static-tibia"}
    assert len(run.stdout.splitlines()) == 3
    assert "`--details` shows the criteria of each" in run.stderr
    both = certkit("run", "static-femur", "--all")
    assert both.returncode == 2
    assert "`--all` and named procedures exclude each other" in both.stderr


def test_a_command_says_on_standard_error_what_to_do_next(certkit: Command) -> None:
    run = certkit("run", "static-femur", "--format", "html", "--out", "a")
    assert "look at a/report.html" in run.stderr
    assert "look at" not in run.stdout
    exported = certkit("export", "a", "a.csv")
    assert "certkit grade --procedure NAME a.csv" in exported.stderr
    compared = certkit("compare", "a", "a", "--out", "c")
    assert "look at c/comparison.html" in compared.stderr
