"""Report time: page and PDF of one procedure over a plain page, and all procedures over version 0.1.0."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from clock import Row, child_seconds, seconds_in_turn
from weasyprint import HTML

import certkit
from certkit.reporting.result_view import view
from certkit.reporting.writing import render

if TYPE_CHECKING:
    from collections.abc import Iterator

ROOT = Path(__file__).parent.parent
FIRST_VERSION = ("v0.1.0", "21e88c1")
"""Tag and commit of version 0.1.0: the first that this checkout knows is taken."""


def rows() -> Iterator[Row]:
    """Yield the time of the plain page, that of our reports, and their ratio; then of all procedures."""
    result = certkit.run("pendulum")
    shown = view(result)
    figures = [drawing.svg for drawing in shown.histories + shown.planes]
    figures += [drawing for drawing in (shown.frames, shown.errors, shown.energies) if drawing]
    plain_page = "<html><body>" + "".join(f"<p>Figure</p>{figure}" for figure in figures) + "</body></html>"
    with tempfile.TemporaryDirectory() as folder:
        plain, ours = seconds_in_turn(
            lambda: HTML(string=plain_page).write_pdf(),
            lambda: render(result, Path(folder), ["html", "pdf"]),
        )
    yield Row(f"WeasyPrint sets a plain page with {len(figures)} figures", plain, "s")
    yield Row("HTML and PDF of the pendulum test, over that page", ours / plain, "", 4)
    with first_version() as first:
        if first is None:
            print("run --all over version 0.1.0: skipped, this checkout has no git history that reaches it")
            return
        yield from _all_procedures(first)


def _all_procedures(first: Path) -> Iterator[Row]:
    """Yield processor times of `run --all` by version 0.1.0 and by this one, and their ratio."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**os.environ, "PYTHONPYCACHEPREFIX": f"{folder}/bytecode", "OPENBLAS_NUM_THREADS": "1"}
        environment.pop("PYTHONDONTWRITEBYTECODE", None)

        def run_all(version: Path) -> None:
            out = f"{folder}/{len(list(Path(folder).iterdir()))}"
            done = subprocess.run(
                [sys.executable, "-m", "certkit", "run", "--all", "--out", out, "--quiet"],
                env=environment | {"PYTHONPATH": str(version)},
                cwd=version,
                capture_output=True,
                text=True,
                check=False,
            )
            if done.returncode not in {0, 1, 4}:
                raise SystemExit(done.stderr)

        run_all(first)  # compiles the solver and the bytecode
        run_all(ROOT)
        before, now = child_seconds(lambda: run_all(first), lambda: run_all(ROOT), repeats=3)
        largest = max(path.stat().st_size for path in Path(folder).glob("*/index.html"))
    yield Row("certkit run --all, version 0.1.0 (processor time)", before, "s")
    yield Row("certkit run --all", now, "s")
    yield Row("run --all over version 0.1.0", now / before, "", 0.5)
    yield Row("index page of all procedures, which holds their reports", largest / 1e6, "MB", 3)


@contextmanager
def first_version() -> Iterator[Path | None]:
    """Check version 0.1.0 out beside this one for a while; None where there is no git or no such commit."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "certkit-0.1.0"
        made = any(_git("worktree", "add", "--detach", str(place), each) for each in FIRST_VERSION)
        try:
            yield place if made else None
        finally:
            if made:
                _git("worktree", "remove", "--force", str(place))


def _git(*arguments: str) -> bool:
    program = shutil.which("git")
    if program is None:
        return False
    return subprocess.run([program, *arguments], cwd=ROOT, capture_output=True, check=False).returncode == 0
