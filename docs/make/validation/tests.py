"""The section on verification: the physics tests, run, each by the sentence that is its name."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ET
from pathlib import Path

from docs.make.markdown import table

ROOT = Path(__file__).parents[3]
SAID = {"passed": "holds", "failed": "**does not hold**", "skipped": "not run here"}


def physics_table() -> str:
    """Run `tests/physics` and return a line a statement."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "physics.xml"
        subprocess.run(  # noqa: S603  # our own tests
            [sys.executable, "-m", "pytest", "--quiet", "tests/physics", f"--junit-xml={report}"],
            cwd=ROOT,
            capture_output=True,
            check=False,
        )
        cases = ET.parse(report).getroot().iter("testcase")  # noqa: S314  # written a moment ago by pytest
        outcomes: dict[tuple[str, str], list[str]] = {}
        for case in cases:
            name = case.get("name", "").partition("[")[0]
            file = case.get("classname", "").rpartition(".")[2]
            outcomes.setdefault((file, name), []).append(_outcome(case))
    rows = [(_statement(name), f"`{file}.py`", _worst(said)) for (file, name), said in outcomes.items()]
    return table(("statement", "test", "outcome"), rows)


def _outcome(case: ET.Element) -> str:
    if case.find("failure") is not None or case.find("error") is not None:
        return "failed"
    return "skipped" if case.find("skipped") is not None else "passed"


def _statement(name: str) -> str:
    words = name.removeprefix("test_").replace("_s_", "'s ").replace("0_05", "0.05").replace("0_1_", "0.1 ")
    return (
        words.replace("_", " ")
        .replace("half a per cent", "0.5 %")
        .replace("per cent", "%")
        .replace("exudyn", "Exudyn")
    )


def _worst(said: list[str]) -> str:
    for outcome in ("failed", "skipped"):
        if outcome in said:
            return SAID[outcome]
    return SAID["passed"]
