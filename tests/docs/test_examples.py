"""Every command and script of the documentation is run, in the order of its page, beside `examples` alone.

What counts as a file, a command and a script stands in `docs/make/examples.py`.
"""

from __future__ import annotations

import os
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from docs.make.examples import Given, Script, Typed, examples

ROOT = Path(__file__).parents[2]
PAGES = sorted((ROOT / "docs").rglob("*.md"))
WITH_COMMANDS = [page for page in PAGES if any(isinstance(e, Typed | Script) for e in examples(page))]


@pytest.mark.slow
@pytest.mark.parametrize("page", WITH_COMMANDS, ids=lambda p: p.stem)
def test_commands_of_a_page_end_as_the_page_says(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    known: dict[str, object] = {"__name__": "page"}
    for each in examples(page):
        if isinstance(each, Given):
            _write(tmp_path / each.name, each.text)
        elif isinstance(each, Script):
            exec(compile(each.text, str(page), "exec"), known)  # noqa: S102  # the documentation's own
        elif each.words.startswith("export "):
            name, _, value = shlex.split(each.words)[1].partition("=")
            monkeypatch.setenv(name, value)
        else:
            _run(each, tmp_path)


def _run(typed: Typed, folder: Path) -> None:
    words = shlex.split(typed.words)
    own = [sys.executable, "-m"] if words[0] == "certkit" else []
    done = subprocess.run(
        [*own, *words],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        env={**os.environ, "NO_COLOR": "1"},
    )
    assert done.returncode == typed.ends_with, f"{typed.words}\n{done.stdout}\n{done.stderr}"
    if typed.keeps:
        _write(folder / typed.keeps, done.stdout)


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
