"""The wheel carries everything: installed in a clean environment, it runs a procedure from another folder."""

from __future__ import annotations

import json
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DATA = ("procedures", "corridors", "models", "references", "schemes", "agreement", "templates", "examples")


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("wheel")
    subprocess.run(
        [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", out, ROOT],
        check=True,
        capture_output=True,
    )
    (built,) = out.glob("*.whl")
    return built


@pytest.mark.slow
def test_the_data_folders_of_the_checkout_travel_in_the_wheel(wheel: Path) -> None:
    inside = set(zipfile.ZipFile(wheel).namelist())
    for folder in DATA:
        files = [p for p in (ROOT / folder).rglob("*") if p.is_file()]
        assert files, f"{folder} is empty"
        missing = [p for p in files if f"certkit/shipped/{p.relative_to(ROOT)}" not in inside]
        assert not missing


@pytest.mark.pdf
@pytest.mark.slow
def test_an_installed_wheel_runs_a_procedure_from_another_folder(wheel: Path, tmp_path: Path) -> None:
    place = tmp_path / "clean"
    subprocess.run([sys.executable, "-m", "venv", place], check=True)
    subprocess.run([place / "bin" / "pip", "install", "--quiet", wheel], check=True, capture_output=True)
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    done = subprocess.run(
        [place / "bin" / "certkit", "run", "--procedure", "static-tibia", "--format", "html,pdf"],
        cwd=elsewhere,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 4, done.stderr  # no area is known to grade by
    folder = elsewhere / "runs" / "static-tibia"
    assert json.loads((folder / "result.json").read_text())["verdict"] == "not evaluated"
    assert (folder / "report.html").stat().st_size > 0
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")
