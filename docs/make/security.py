"""The figures of security.md: forgeries, bombs, kills, writers and environments, and what came of each."""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import certkit
from certkit.files import write_whole
from certkit.reporting.pdf_report import certificate
from certkit.reporting.result_view import unique_views
from docs.make import trials
from docs.make.markdown import table
from docs.make.reference import DOCS

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

ROOT = DOCS.parent
PARTS = ("forgeries", "limits", "bombs", "kills", "writers", "environments")


def write_security(
    tell: Callable[[str], None], parts: Sequence[str] = PARTS, *, kills: int = 10, pythons: Sequence[str] = ()
) -> Path:
    """Try again what some parts of security.md tell of, and write what came of it.

    Parameters
    ----------
    tell : callable
        Told of each trial.
    parts : sequence of str
        Some of `PARTS`.
    kills : int
        How often each kind of command is killed.
    pythons : sequence of str
        Further interpreters to make certificates with.
    """
    sys.path.insert(0, str(ROOT / "tests"))
    make = {
        "forgeries": lambda: _forgeries(tell),
        "limits": trials.limits_table,
        "bombs": lambda: trials.bombs(tell),
        "kills": lambda: trials.kills(tell, kills),
        "writers": lambda: trials.writers(tell),
        "environments": lambda: trials.environments(tell, pythons),
    }
    path = DOCS / "security.md"
    for part in parts:
        made = make[part]()
        text = path.read_text("utf-8")  # as it is by now
        begin, end = f"<!-- {part} -->", f"<!-- end of {part} -->"
        before, rest = text.split(begin)
        write_whole(path, f"{before}{begin}\n\n{made}\n\n{end}{rest.split(end)[1]}")
    return path


def _forgeries(tell: Callable[[str], None]) -> str:
    from support import forgeries, further_forgeries  # noqa: PLC0415  # need pikepdf, and the tests' folder
    from support.forgeries import forged, told_of  # noqa: PLC0415  # likewise

    data = ROOT / "examples" / "measured"
    measured = certkit.grade("pendulum", data / "FLX-0007-pendulum.zip", laboratory=data / "lab.yaml")
    changed = {"rig.release.angle": "15.4 deg"}
    genuine = {
        "measured": measured.as_written(),
        "simulated": certkit.run("inverse", refine=False).as_written(),
        "simulated overridden": certkit.run("pendulum", overrides=changed, refine=False).as_written(),
        "pdf": certificate(unique_views([measured.as_written()])),
    }
    every = [
        *(*forgeries.DOCUMENTS, *further_forgeries.DOCUMENTS),
        *(*forgeries.PAPERS, *further_forgeries.PAPERS),
    ]
    rows, named = [], 0
    for forgery in every:
        with tempfile.TemporaryDirectory() as folder:
            outcome, told = told_of(forged(forgery, genuine[forgery.kind], Path(folder)))
        hits = [each for each in told if re.search(forgery.named, f"{each[0]} {each[1]}")]
        named += bool(hits) and outcome != "holds"
        what, _, said = hits[0] if hits else ("nothing", "", "")
        rows.append((forgery.name, forgery.kind, outcome, f"{what}: {said}".replace("<", "&lt;")))
        tell(f"{forgery.name}: {outcome}")
    head = f"{len(rows)} forgeries tried, {named} named."
    return f"{head}\n\n" + table(
        ("forged", "certificate", "outcome", "what `certkit verify` says first"), rows
    )
