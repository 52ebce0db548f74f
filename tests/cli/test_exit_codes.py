"""The exit code is a gate: each of the contract's codes, through the real command."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from support.command import Command

STEEP = "legform.parts.femur.bending stiffness=90 N·m²"


def test_a_pass_ends_with_0(certkit: Command) -> None:
    done = certkit("run", "--procedure", "pendulum", "--format", "junit")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "PASS" in done.stdout


def test_without_reports_the_document_alone_is_written(certkit: Command, table: Path, tmp_path: Path) -> None:
    bare = ("--format", "none", "--allow", "not-evaluated", "--out")
    simulated = certkit("run", "-p", "static-tibia", *bare, "run")
    assert simulated.returncode == 0, simulated.stderr
    graded = certkit("grade", "-p", "pendulum", str(table), *bare, "graded")
    assert graded.returncode == 0, graded.stderr
    for folder in ("run", "graded"):
        assert [path.name for path in (tmp_path / folder).iterdir()] == ["result.json"]


def test_a_value_outside_its_corridor_ends_with_1(certkit: Command, tmp_path: Path) -> None:
    done = certkit("run", "--procedure", "inverse", "--set", "rig.ram.speed=13 m/s", "--format", "junit")
    assert done.returncode == 1
    result = json.loads((tmp_path / "runs" / "inverse" / "result.json").read_text())
    assert result["verdict"] == "fail"
    assert result["provenance"]["overrides"] == [
        {"path": "rig.ram.speed", "value": "13 m/s", "was": "11.1 m/s"}
    ]


def test_a_bad_definition_ends_with_2_and_writes_nothing(certkit: Command, tmp_path: Path) -> None:
    (tmp_path / "bad.yaml").write_text("procedure: bad\ntitle: 3\n")
    done = certkit("run", "--procedure", "bad.yaml")
    assert done.returncode == 2
    assert "bad.yaml:" in done.stderr
    assert not (tmp_path / "runs").exists()


@pytest.mark.parametrize(
    "arguments",
    [
        ("run",),
        ("run", "--procedure", "pendulun"),
        ("run", "--procedure", "pendulum", "--set", "rig.hinje.offset=3 mm"),
        ("run", "--procedure", "pendulum", "--format", "docx"),
        ("run", "--procedure", "pendulum", "--allow", "fail"),
        ("run", "--all", "--procedure", "pendulum"),
        ("report", "nowhere.json"),
        ("no-such-command",),
    ],
    ids=" ".join,
)
def test_a_command_line_that_cannot_be_carried_out_ends_with_2(
    certkit: Command, arguments: tuple[str]
) -> None:
    done = certkit(*arguments)
    assert done.returncode == 2, done.stdout + done.stderr
    assert "Traceback" not in done.stderr


def test_a_misspelt_procedure_is_answered_with_the_nearest_name(certkit: Command) -> None:
    assert "pendulum" in certkit("run", "--procedure", "pendulun").stderr


def test_a_run_that_cannot_be_trusted_ends_with_3(certkit: Command) -> None:
    done = certkit("run", "--procedure", "inverse", "--set", "run.time step=0.4 ms", "--format", "junit")
    assert done.returncode == 3, done.stdout + done.stderr
    assert "PASS" not in done.stdout


def test_a_test_nobody_has_corridors_for_ends_with_4(certkit: Command) -> None:
    done = certkit("run", "--procedure", "static-knee", "--format", "junit")
    assert done.returncode == 4
    assert "NOT EVALUATED" in done.stdout


def test_not_evaluated_can_be_allowed(certkit: Command) -> None:
    arguments = ("run", "--procedure", "static-knee", "--format", "junit", "--allow", "not-evaluated")
    assert certkit(*arguments).returncode == 0


def test_with_several_procedures_the_worst_counts(certkit: Command) -> None:
    done = certkit("run", "-p", "static-tibia", "-p", "static-knee", "--format", "junit")
    assert done.returncode == 4


def test_a_procedure_that_cannot_run_does_not_take_the_others_with_it(
    certkit: Command, tmp_path: Path
) -> None:
    done = certkit("run", "-p", "static-tibia", "-p", "no-such", "--format", "junit")
    assert done.returncode == 2
    assert (tmp_path / "runs" / "static-tibia" / "result.json").exists()


def test_a_damaged_recording_is_told_and_does_not_stop_the_others(
    certkit: Command, table: Path, tmp_path: Path
) -> None:
    text = table.read_text(encoding="utf-8")
    for name in ("first", "last"):
        (tmp_path / f"{name}.csv").write_text(text, encoding="utf-8")
    (tmp_path / "torn.csv").write_text(text[:-20], encoding="utf-8")
    done = certkit("grade", "-p", "pendulum", "first.csv", "torn.csv", "last.csv", "--format", "junit")
    assert done.returncode == 2
    assert "torn.csv:" in done.stderr
    assert "Traceback" not in done.stderr
    assert {path.parent.name for path in tmp_path.glob("runs/*/result.json")} == {"first", "last"}


def test_a_program_that_calls_the_command_keeps_its_search_for_garbage() -> None:
    program = (
        "import gc, sys\n"
        "from certkit.cli import main\n"
        "sys.argv = ['certkit', 'list', 'procedures']\n"
        "try: main()\n"
        "finally: print('frozen', gc.get_freeze_count())\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert done.stdout.splitlines()[-1] == "frozen 0", done.stderr
