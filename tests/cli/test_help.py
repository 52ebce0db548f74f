"""Asking for help costs nothing heavy."""

from __future__ import annotations

import subprocess
import sys

import pytest

HEAVY = {"numpy", "pymunk", "matplotlib", "scipy", "weasyprint", "pandas", "numba", "jinja2"}
PROBE = """
import sys
from certkit.cli.commands import app_for
try:
    app_for(sys.argv[1:])()
except SystemExit:
    pass
print("LOADED", *sorted({name.partition(".")[0] for name in sys.modules}), file=sys.stderr)
"""
COMMANDS = [
    "run",
    "roundrobin",
    "grade",
    "compare",
    "report",
    "extract",
    "calibrate",
    "study",
    "list",
    "show",
    "validate",
]


@pytest.mark.parametrize("arguments", [["--help"], *([name, "--help"] for name in COMMANDS)], ids=" ".join)
def test_help_imports_nothing_heavy(arguments: list[str]) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROBE, *arguments], capture_output=True, text=True, check=True
    )
    assert "Usage" in done.stdout
    loaded = set(done.stderr.split("LOADED", 1)[1].split())
    assert not loaded & HEAVY
    # typer itself asks pydantic to read options; the list of commands has none.
    assert arguments != ["--help"] or "pydantic" not in loaded


@pytest.mark.parametrize("command", ["calibrate", "study", "uncertainty"])
def test_whatever_runs_on_a_cluster_can_prove_who_it_is(command: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "certkit", command, "anything", "--tls-ca-file", "ca.pem"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "No such option" not in done.stderr
