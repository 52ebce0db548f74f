"""The pictures of the documentation, all made from fresh runs."""

from __future__ import annotations

import shlex
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from certkit.definitions.loading.search_path import shipped_root
from docs.make.examples import Given, examples
from docs.make.reference import DOCS
from docs.make.scenes import FIGURES, RUNS, TERMINAL
from docs.make.screens import Screen, leaf, photograph, terminal

if TYPE_CHECKING:
    from collections.abc import Callable

TWO_COLUMNS = "figure.chart { display: inline-block; width: 49%; margin: 0 }"
SCREENS = {
    "report-light": Screen("suite/pendulum/report.html"),
    "report-dark": Screen("suite/inverse/report.html", dark=True, at=12.0, scroll="[data-player]"),
    "report-phone": Screen("suite/pendulum/report.html", width=390, height=844),
    "suite": Screen("suite/index.html", height=700),
    "study": Screen("study/study.html", scroll="section:has(svg)"),
    "campaign": Screen("campaign/campaign.html", height=1250),
    "fe-motion": Screen("front/extraction.html", at=20.0, part="section.motion"),
    "fe-moments": Screen("compared/comparison.html", part="section:has(figure)", style=TWO_COLUMNS),
}
PAGES = {"certificate-1": 1, "certificate-2": 2}
GIVING = DOCS / "how-to" / "study.md"
"""The page whose files the runs need."""


def write_pictures(folder: Path = DOCS / "pictures", *, tell: Callable[[str], None] = print) -> list[Path]:
    """Run everything and draw all pictures into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as temporary:
        runs = Path(temporary)
        _lay_out(runs)
        for command in RUNS:
            tell(command)
            _certkit(command, runs)
        written = [_figure(name, command, runs, folder) for name, command in FIGURES.items()]
        tell(TERMINAL)
        written.append(terminal(TERMINAL, runs, folder / "terminal.svg"))
        tell("taking pictures of pages")
        written += photograph(SCREENS, runs, folder)
        certificate = runs / "suite" / "pendulum" / "report.pdf"
        written += [leaf(certificate, number, folder / f"{name}.png") for name, number in PAGES.items()]
    return written


def _lay_out(runs: Path) -> None:
    """Put the files that the page gives where the runs find them."""
    for given in examples(GIVING):
        if isinstance(given, Given):
            (runs / given.name).write_text(given.text)


def _figure(name: str, command: str, runs: Path, folder: Path) -> Path:
    base = folder / name
    _certkit(f"{command} --format svg --force --out {shlex.quote(str(base))}", runs)
    return base.with_suffix(".svg")


def _certkit(command: str, runs: Path) -> None:
    """Run a command; a verdict of any kind is fine, an error is not.

    Raises
    ------
    RuntimeError
        With what the command said.
    """
    words = shlex.split(command.replace("EXAMPLES", str(shipped_root() / "examples")))
    done = subprocess.run(  # noqa: S603  # our own command
        [sys.executable, "-m", *words], cwd=runs, capture_output=True, text=True, check=False
    )
    if done.returncode in {2, 3}:
        raise RuntimeError(f"{command}\n{done.stdout}{done.stderr}")
