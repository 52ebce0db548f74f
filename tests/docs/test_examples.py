"""Every command that the documentation shows is run, in the order of its page, beside `examples` alone.

A block fenced as `yaml` that begins with `# file: NAME` is written to that file first. In a block fenced as
`console`, a line `$ certkit …` is run; `> FILE` at its end keeps what it prints; the comment `# exit N` names
the exit code it must end with (0 when there is none).
"""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
BLOCK = re.compile(r"^```(yaml|console)[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def _commands(block: str) -> list[tuple[str, int]]:
    found = []
    for line in block.splitlines():
        if line.startswith("$ certkit "):
            text, _, comment = line[2:].partition("  # exit ")
            found.append((text.strip(), int(comment or 0)))
    return found


WITH_COMMANDS = [page for page in PAGES if "\n$ certkit " in page.read_text()]


@pytest.mark.slow
@pytest.mark.parametrize("page", WITH_COMMANDS, ids=lambda p: p.stem)
def test_commands_of_a_page_end_as_the_page_says(page: Path, tmp_path: Path) -> None:
    ran = 0
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    for kind, text in BLOCK.findall(page.read_text()):
        if kind == "yaml" and text.startswith("# file: "):
            written = tmp_path / text.splitlines()[0].removeprefix("# file: ").strip()
            written.parent.mkdir(parents=True, exist_ok=True)
            written.write_text(text)
        for line, expected in _commands(text) if kind == "console" else ():
            command, _, target = line.partition(" > ")
            done = subprocess.run(
                [sys.executable, "-m", *shlex.split(command)],
                cwd=tmp_path,
                capture_output=True,
                text=True,
                timeout=300,
                check=False,
                env={**os.environ, "NO_COLOR": "1"},
            )
            assert done.returncode == expected, f"{command}\n{done.stdout}\n{done.stderr}"
            if target:
                (tmp_path / target).parent.mkdir(parents=True, exist_ok=True)
                (tmp_path / target).write_text(done.stdout)
            ran += 1
    assert ran, f"{page.name} shows no command that was run"
