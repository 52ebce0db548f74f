"""`certkit extract` as a user calls it."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

BUMPER = Path(__file__).parents[2] / "examples/extract/bumper-reference"


def certkit(*words: str | Path, folder: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-c", "from certkit.cli import main; main()", *map(str, words)]
    environment = {"PYTHONPATH": str(Path(__file__).parents[2]), "PATH": "/usr/bin:/bin"}
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


@pytest.fixture
def case(tmp_path: Path) -> Path:
    for name in ("case-tidy.yaml", "histories.csv", "foam-curve.csv"):
        shutil.copy(BUMPER / name, tmp_path)
    return tmp_path / "case-tidy.yaml"


def test_one_command_writes_vehicle_result_and_report(case: Path) -> None:
    done = certkit("extract", case, "--out", "found", "--format", "html", folder=case.parent)
    assert done.returncode == 0, done.stderr
    assert sorted(p.name for p in (case.parent / "found").iterdir()) == [
        "extraction.html",
        "extraction.json",
        "vehicle.yaml",
    ]
    assert "stress–strain of fascia – beam" in done.stdout


def test_the_result_alone_goes_to_standard_output_with_json(case: Path) -> None:
    done = certkit("extract", case, "--json", "--format", "html", folder=case.parent)
    assert json.loads(done.stdout)["case"] == "bumper-reference"


def test_without_a_report_the_reader_is_sent_to_the_document(case: Path) -> None:
    done = certkit("extract", case, "--out", "found", "--format", "none", "--no-checks", folder=case.parent)
    assert done.returncode == 0, done.stderr
    assert "look at found/extraction.json" in done.stderr
    assert {path.name for path in (case.parent / "found").iterdir()} == {"extraction.json", "vehicle.yaml"}


def test_histories_may_lie_elsewhere(case: Path, tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    shutil.move(tmp_path / "histories.csv", tmp_path / "other")
    done = certkit("extract", case, "--data", "other", "--format", "html", folder=case.parent)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("file", "old", "new", "message"),
    [
        (
            "histories.csv",
            "66.6,0,0,0,66.6",
            "66.6,zero,0,0,66.6",
            "histories.csv:2: column `P_fascia_Ns`: `zero`",
        ),
        ("case-tidy.yaml", "parts: [back_beam]", "parts: [front_beam]", "no part `front_beam`"),
        ("case-tidy.yaml", "paths:", "pathes:", "case-tidy.yaml:"),
    ],
)
def test_damage_ends_with_exit_code_2_one_error_and_nothing_written(
    case: Path, file: str, old: str, new: str, message: str
) -> None:
    path = case.parent / file
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    done = certkit("extract", case, "--out", "found", folder=case.parent)
    assert done.returncode == 2
    assert message in done.stderr
    assert "Traceback" not in done.stderr
    assert not (case.parent / "found").exists()


def test_an_unknown_report_format_is_refused_before_anything_is_read(case: Path) -> None:
    done = certkit("extract", case, "--format", "docx", folder=case.parent)
    assert done.returncode == 2
    assert "no extraction in the format `docx`; use html, pdf" in done.stderr


def test_an_impulse_that_does_not_close_ends_with_exit_code_1_and_without_a_vehicle(case: Path) -> None:
    text = case.read_text().replace("back_beam: {mass: 3.91872 kg", "back_beam: {mass: 3.9 kg")
    case.write_text(text.replace("contact: fascia-foam", "contact: impactor-fascia", 1))
    done = certkit("extract", case, "--out", "found", "--format", "none", folder=case.parent)
    assert done.returncode == 1
    assert "does not close" in done.stderr
    assert not (case.parent / "found" / "vehicle.yaml").exists()
    told = certkit("extract", case, "--out", "told", "--format", "none", "--unclosed", folder=case.parent)
    assert told.returncode == 1
    assert (case.parent / "told" / "vehicle.yaml").exists()


def test_a_front_that_does_not_move_as_in_its_run_ends_with_exit_code_3(case: Path) -> None:
    case.write_text(case.read_text() + "settings: {movement limit: 0.01}\n")
    done = certkit("extract", case, "--out", "found", "--format", "none", folder=case.parent)
    assert done.returncode == 3
    assert "cannot be trusted: The front alone" in done.stderr


def test_an_impulse_that_nothing_tells_of_leaves_the_word_to_the_self_checks(case: Path) -> None:
    case.write_text(case.read_text().replace(", contact: fascia-foam", ""))
    done = certkit("extract", case, "--out", "found", "--format", "none", folder=case.parent)
    assert done.returncode == 0, done.stderr
    assert "nothing tells whether its impulse closes" in done.stderr
    assert (case.parent / "found" / "vehicle.yaml").exists()
    words = ("extract", case, "--out", "blind", "--format", "none", "--no-checks")
    assert certkit(*words, folder=case.parent).returncode == 1
    assert not (case.parent / "blind" / "vehicle.yaml").exists()
