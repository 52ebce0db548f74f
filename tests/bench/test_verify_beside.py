"""Verify says what it does not vouch for: files beside a document, documents that nothing follows from."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest
from support import synthetic_extraction
from support.small_documents import ROUND_ROBIN

import certkit
from certkit.bench.verify import verify
from certkit.documents.output_document import OutputDocument
from certkit.documents.result import Result
from certkit.reporting.language import worded

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def graded() -> Result:
    data = EXAMPLES / "measured"
    return certkit.grade("pendulum", data / "FLX-0007-pendulum.zip", laboratory=data / "lab.yaml")


def failed(path: Path) -> list[str]:
    return [check.what for check in verify(path).of("does not hold")]


def test_a_page_that_nobody_wrote_here_is_not_vouched_for(graded: Result, tmp_path: Path):
    certkit.render(graded, tmp_path, "html")
    assert not [check for check in verify(tmp_path).checks if check.what == "other files"]
    forged = (tmp_path / "report.html").read_text("utf-8").replace("254", "262")
    (tmp_path / "certificate.html").write_text(forged, "utf-8")
    (tmp_path / "signed").mkdir()
    found = verify(tmp_path)
    (told,) = [check for check in found.checks if check.what == "other files"]
    assert (told.outcome, told.asked) == ("not checked", False)
    assert told.said.startswith("certificate.html, signed: ")
    assert found.holds


def test_a_changed_conclusion_with_a_fresh_id_is_not_said_to_hold(tmp_path: Path):
    document = worded(ROUND_ROBIN).with_id()
    forged = document.model_copy(update={"title": "All laboratories agree"}).with_id()
    for number, each in enumerate((document, forged)):
        folder = tmp_path / str(number)
        certkit.render(each, folder, "html")
        found = verify(folder)
        assert [check.what for check in found.of("not checked")] == ["content"]
        assert found.outcome == "not checked"
    page = tmp_path / "0" / "round-robin.html"
    page.write_text(page.read_text("utf-8").replace("</h1>", ", accredited</h1>"), "utf-8")
    assert failed(tmp_path / "0") == ["round-robin.html"]


@pytest.mark.parametrize("language", ["en", "de", "ja"])
def test_pages_beside_a_document_are_held_to_it_in_their_language(tmp_path: Path, language: str):
    document: OutputDocument = worded(ROUND_ROBIN).with_id()
    certkit.render(document, tmp_path, "html", language=language)
    assert failed(tmp_path) == []


def test_another_vehicle_beside_an_extraction_is_named(tmp_path: Path):
    certkit.render(synthetic_extraction.extraction().with_id(), tmp_path, "html")
    vehicle = tmp_path / "vehicle.yaml"
    assert failed(tmp_path) == []
    vehicle.write_text(vehicle.read_text("utf-8") + "\n# softer", "utf-8")
    assert failed(tmp_path) == ["vehicle.yaml"]


def test_a_campaign_does_not_rest_on_a_forged_test(
    graded: Result, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """The value that a test lost is made up, and all ids and judgements anew: only grading again shows it."""
    # A campaign grades again what it takes over; whoever forges one goes round that.
    monkeypatch.setattr("certkit.bench.point_sources.wrong_values", lambda *_: [])
    car = "campaign: car\ntitle: A car\ncar: {name: Car, test area: [-600 mm, 600 mm], symmetric: true}\n"
    (tmp_path / "car.yaml").write_text(
        f"{car}schemes: [r127]\npoints:\n  - {{point: a, across: 0 mm, sources: [{{measured: test.json}}]}}\n"
    )
    criteria = [
        each.model_copy(update={"value": 240.0}) if each.id == "T1" else each for each in graded.criteria
    ]
    for name, result in (("true", graded), ("forged", graded.model_copy(update={"criteria": criteria}))):
        result.with_id().write(tmp_path / "test.json")
        certkit.campaign(tmp_path / "car.yaml", tmp_path / name)
    assert failed(tmp_path / "true") == []
    assert failed(tmp_path / "forged")[0] == "point a: measured: graded again: T1"


def test_another_certificate_beside_a_legforms_certificate_is_named(tmp_path: Path):
    folder = EXAMPLES / "certification"
    laboratory = tmp_path / "laboratory"
    shutil.copytree(folder, laboratory)
    shutil.copy(EXAMPLES / "measured" / "FLX-0007-pendulum.zip", laboratory)
    runs = []
    for name in ("static-femur", "static-tibia", "static-knee", "pendulum", "inverse"):
        result = certkit.grade(
            name, laboratory / f"FLX-0007-{name}.zip", laboratory=laboratory / f"{name}.yaml"
        )
        certkit.render(result, tmp_path / "runs" / name, "none")
        runs.append(tmp_path / "runs" / name)
    for number, day in enumerate(("2026-03-10", "2026-03-11")):
        made = certkit.certify(
            "FLX-0007",
            runs,
            folder=tmp_path / "logbook",
            laboratory=laboratory / "lab.yaml",
            day=day,
        )
        certkit.render(made, tmp_path / str(number), "pdf")
    assert failed(tmp_path / "0") == []
    shutil.copy(tmp_path / "1" / "certificate.pdf", tmp_path / "0")
    assert failed(tmp_path / "0") == ["certificate.pdf: certificate"]
    assert json.loads((tmp_path / "0" / "certificate.json").read_text())["day"] == "2026-03-10"
