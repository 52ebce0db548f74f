"""The figures of security.md: every forgery tried, and what `verify` says of it."""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import certkit
from certkit.bench.verify import verify
from certkit.files import write_whole
from certkit.reporting.pdf_report import certificate
from certkit.reporting.result_view import unique_views
from docs.make.markdown import table
from docs.make.reference import DOCS

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = DOCS.parent
BEGIN, END = "<!-- forgeries -->", "<!-- end of forgeries -->"


def write_security(tell: Callable[[str], None]) -> Path:
    """Try every forgery and write what came of it into security.md."""
    page = DOCS / "security.md"
    before, rest = page.read_text("utf-8").split(BEGIN)
    after = rest.split(END)[1]
    write_whole(page, f"{before}{BEGIN}\n\n{_forgeries(tell)}\n\n{END}{after}")
    return page


def _forgeries(tell: Callable[[str], None]) -> str:
    sys.path.insert(0, str(ROOT / "tests"))
    from support.forgeries import DOCUMENTS, PAPERS, forged  # noqa: PLC0415  # needs pikepdf, and the tests' folder

    data = ROOT / "examples" / "measured"
    measured = certkit.grade("pendulum", data / "FLX-0007-pendulum.zip", laboratory=data / "lab.yaml")
    changed = {"rig.release.angle": "15.4 deg"}
    genuine = {
        "measured": measured.as_written(),
        "simulated": certkit.run("inverse", refine=False).as_written(),
        "simulated overridden": certkit.run("pendulum", overrides=changed, refine=False).as_written(),
        "pdf": certificate(unique_views([measured.as_written()])),
    }
    rows, named = [], 0
    for forgery in (*DOCUMENTS, *PAPERS):
        with tempfile.TemporaryDirectory() as folder:
            found = verify(forged(forgery, genuine[forgery.kind], Path(folder)))
        said = [c for c in found.checks if c.asked and not c.holds]
        hits = [c for c in said if re.search(forgery.named, f"{c.what} {c.code}")]
        named += bool(hits)
        first = hits[0] if hits else None
        told = f"{first.what}: {first.said}" if first else "nothing"
        rows.append((forgery.name, forgery.kind, found.outcome, told.replace("|", "\\|")))
        tell(f"{forgery.name}: {found.outcome}")
    head = f"{len(rows)} forgeries tried, {named} named."
    return f"{head}\n\n" + table(
        ("forged", "certificate", "outcome", "what `certkit verify` says first"), rows
    )
