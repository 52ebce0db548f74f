"""Every forgery that we could think of is named by `verify`, whoever made the hashes anew."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from support.forgeries import DOCUMENTS, PAPERS, Forgery, forged

import certkit
from certkit.bench.verify import verify
from certkit.documents.result import Result
from certkit.reporting.pdf_report import certificate
from certkit.reporting.result_view import unique_views

DATA = Path(__file__).parents[2] / "examples" / "measured"


@pytest.fixture(scope="module")
def genuine() -> dict[str, Result | bytes]:
    """A measured certificate, two simulated ones, and the measured one's PDF."""
    measured = certkit.grade("pendulum", DATA / "FLX-0007-pendulum.zip", laboratory=DATA / "lab.yaml")
    changed = {"rig.release.angle": "15.4 deg"}
    return {
        "measured": measured.as_written(),
        "simulated": certkit.run("inverse", refine=False).as_written(),
        "simulated overridden": certkit.run("pendulum", overrides=changed, refine=False).as_written(),
        "pdf": certificate(unique_views([measured.as_written()])),
    }


@pytest.mark.parametrize("kind", ["measured", "simulated", "simulated overridden", "pdf"])
def test_the_genuine_ones_hold(genuine: dict[str, Result | bytes], kind: str, tmp_path: Path):
    path = forged(Forgery("none", kind, lambda given: given, ""), genuine[kind], tmp_path)
    found = verify(path)
    assert found.holds, [(c.what, c.code, c.said) for c in found.checks if not c.holds]


@pytest.mark.parametrize("forgery", [*DOCUMENTS, *PAPERS], ids=lambda forgery: forgery.name)
def test_a_forgery_is_named(genuine: dict[str, Result | bytes], forgery: Forgery, tmp_path: Path):
    found = verify(forged(forgery, genuine[forgery.kind], tmp_path))
    assert not found.holds
    named = [f"{check.what} {check.code}" for check in found.checks if check.asked and not check.holds]
    assert any(re.search(forgery.named, each) for each in named), named


def test_at_least_forty_forgeries_are_tried():
    assert len({forgery.name for forgery in (*DOCUMENTS, *PAPERS)}) >= 40
