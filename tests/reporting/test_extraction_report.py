from __future__ import annotations

import io
import json
import re
from typing import TYPE_CHECKING

import pikepdf
import pytest
from support import synthetic_extraction
from support.synthetic_result import parsed

from certkit.documents.extraction import ClosureResult, GroupResult, LawResult, MaterialResult, PathResult
from certkit.errors import UsageError
from certkit.identification import ExtractionResult
from certkit.reporting.document_reports import render_document
from certkit.reporting.extraction_report import extraction_page
from certkit.reporting.extraction_text import check_sentence
from certkit.reporting.figure_files import figure_files
from certkit.reporting.figure_list import FIGURES
from certkit.reporting.figures import drawn

if TYPE_CHECKING:
    from pathlib import Path

RAMP = tuple(float(k) for k in range(50))
SHORTENING = tuple(1e-3 * min(k, 60 - k) for k in RAMP)


@pytest.fixture
def extraction() -> ExtractionResult:
    """Return a made-up extraction with one path that pushed and one that never did."""
    law = LawResult(
        shortening=(0.0, 0.05),
        force=(0.0, 5e3),
        unloading=2e5,
        residual=0.3,
        permanent_set=0.01,
        damping=100.0,
        tension=False,
        misfit_percent=2.5,
        unloaded=True,
    )
    path = PathResult(
        name="foam",
        source="fascia",
        target="beam",
        known_by="momentum upstream of the cut",
        impulse=RAMP,
        force=tuple(100 * k for k in RAMP),
        shortening=SHORTENING,
        recorded_force=tuple(101 * k for k in RAMP),
        force_error_percent=1.0,
        closures=(ClosureResult(title="fascia", residual=0.1, impulse=20.0, percent=0.5),),
        law=law,
        peak_force=4900.0,
        peak_time=0.049,
    )
    idle = PathResult(
        **{
            **path.__dict__,
            "name": "idle",
            "force": (0.0,) * 50,
            "recorded_force": None,
            "force_error_percent": None,
            "law": None,
            "closures": (),
        }
    )
    material = MaterialResult(
        path="foam",
        length=0.08,
        area=0.02,
        strain=(0.0, 0.3, 0.6),
        stress=(0.0, 2e5, 4e5),
        unloading_strain=(),
        unloading_stress=(),
        reference_strain=(0.0, 0.6),
        reference_stress=(0.0, 4.1e5),
        strain_from=0.05,
        rms_percent=3.2,
        mean_percent=-1.0,
        uniform=True,
        spread_percent=2.0,
    )
    return ExtractionResult(
        case="bumper",
        title="A bumper <of foam>",
        start=0.0,
        interval=1e-3,
        count=50,
        smoothing=0.0,
        groups=(
            GroupResult(
                name="fascia", kind="group", parts=("1", "2"), mass=1.5, momentum=RAMP, displacement=RAMP
            ),
        ),
        paths=(path, idle),
        vehicle="bumper",
        material=material,
        warnings=("the curve ends early",),
        notes=(),
        inputs={"case.yaml": "ab" * 32},
    )


def test_the_terminal_calls_gauges_moments_and_sets_ratios() -> None:
    front = synthetic_extraction.extraction()
    said = " ".join(check_sentence(check) for check in front.checks)
    gauges = {channel.name for check in front.checks for channel in check.channels}
    assert gauges & {"F1", "T1"}
    assert not [name for name in gauges if f" {name}," in said]
    page = extraction_page(front)
    assert "permanent set 30 % of the largest shortening" in page
    assert not re.search(r"permanent set[^.;]*\d\s*mm", page)


def test_warnings_come_before_the_curves(extraction: ExtractionResult) -> None:
    html = extraction_page(extraction)
    assert html.index("the curve ends early") < html.index("Load paths")
    assert "<of foam>" not in html


def test_a_path_that_never_pushed_is_listed_but_not_drawn(extraction: ExtractionResult) -> None:
    html = extraction_page(extraction)
    assert '<th scope="row">idle</th>' in html
    assert "<h2>idle</h2>" not in html


@pytest.mark.parametrize("what", FIGURES["certkit-extraction/1"])
def test_each_figure_can_be_drawn(extraction: ExtractionResult, what: str) -> None:
    front = synthetic_extraction.extraction().model_copy(update={"material": extraction.material})
    drawing = str(drawn(front, what))
    assert any(e.tag.endswith("path") and e.get("d") for e in parsed(drawing).iter())


def test_a_path_that_is_not_there_is_named(extraction: ExtractionResult) -> None:
    with pytest.raises(UsageError, match="no load path `roof`; there are foam, idle"):
        drawn(extraction, "force", ["roof"])


def test_the_pdf_carries_the_extraction_it_shows(extraction: ExtractionResult, tmp_path: Path) -> None:
    written = render_document(extraction, tmp_path, ["html", "pdf"])
    assert {path.name for path in written} == {"extraction.html", "extraction.pdf"}
    with pikepdf.open(io.BytesIO((tmp_path / "extraction.pdf").read_bytes())) as pdf:
        attached = pdf.attachments["extraction.json"].get_file().read_bytes()
    assert json.loads(attached) == json.loads(extraction.to_json())


def test_the_figure_command_tells_an_extraction_from_a_result(
    extraction: ExtractionResult, tmp_path: Path
) -> None:
    document = tmp_path / "extraction.json"
    document.write_text(extraction.with_id().to_json())
    name, contents = figure_files(document, "stiffness", ["svg"], channels=["foam"])
    assert name == "bumper"
    assert contents["svg"].startswith(b"<svg")
    with pytest.raises(UsageError, match="unknown figure `corridor` of a"):
        figure_files(document, "corridor", ["svg"])
