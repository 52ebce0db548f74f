"""Every forgery that we could think of is named by `verify`, whoever made the hashes anew."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from support import forgeries, further_forgeries
from support.forgeries import Forgery, forged, told_of

import certkit
from certkit.bench import verify_pages
from certkit.bench.pdf_attachments import Attached
from certkit.bench.verify import verify
from certkit.bench.verify_pages import rendered_again
from certkit.documents.result import Result
from certkit.reporting.pdf_report import certificate
from certkit.reporting.result_view import unique_views

DATA = Path(__file__).parents[2] / "examples" / "measured"


EVERY = [
    *forgeries.DOCUMENTS,
    *further_forgeries.DOCUMENTS,
    *forgeries.PAPERS,
    *further_forgeries.PAPERS,
]


@pytest.fixture(scope="module", autouse=True)
def _rendered_once() -> Iterator[None]:
    """Render each document once: most forgers of pages leave it as it is."""
    kept: dict[str, object] = {}

    def once(results: Sequence[Result], attached: Attached) -> object:
        key = str([[each.to_json() for each in results], attached.paper, attached.language, attached.created])
        if key not in kept:
            kept[key] = rendered_again(results, attached)
        return kept[key]

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(verify_pages, "rendered_again", once)
        yield


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


def test_a_pdf_that_another_program_wrote_again_is_not_called_forged(
    genuine: dict[str, Result | bytes], tmp_path: Path
):
    again = next(each for each in EVERY if each.name == "written by another program")
    outcome, told = told_of(forged(again, genuine["pdf"], tmp_path))
    assert (outcome, [code for _, code, _ in told]) == ("not checked", ["pages-rewritten"])


@pytest.mark.parametrize("forgery", EVERY, ids=lambda forgery: forgery.name)
def test_a_forgery_is_named(genuine: dict[str, Result | bytes], forgery: Forgery, tmp_path: Path):
    outcome, told = told_of(forged(forgery, genuine[forgery.kind], tmp_path))
    assert outcome != "holds"
    assert any(re.search(forgery.named, f"{what} {code}") for what, code, _ in told), told


@pytest.mark.parametrize(
    "forgery", [each for each, _ in further_forgeries.OUTSIDE], ids=lambda each: each.name
)
def test_what_is_not_promised_is_not_seen_and_stands_in_the_documentation(
    genuine: dict[str, Result | bytes], forgery: Forgery, tmp_path: Path
):
    assert told_of(forged(forgery, genuine[forgery.kind], tmp_path))[0] == "holds"
    page = (Path(__file__).parents[2] / "docs" / "security.md").read_text("utf-8")
    assert f"| {forgery.name} |" in page


def test_at_least_forty_forgeries_are_tried_each_under_a_name_of_its_own():
    assert len({forgery.name for forgery in EVERY}) == len(EVERY) >= 40
