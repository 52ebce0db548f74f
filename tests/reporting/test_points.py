"""Points of a rating scheme stand wherever a verdict does: terminal, JUnit, Markdown, page and PDF."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import pytest
from support.synthetic_result import parsed, result

from certkit.documents.result import Result, ScoreResult
from certkit.reporting.html_report import page
from certkit.reporting.junit import junit
from certkit.reporting.markdown import summary
from certkit.reporting.result_view import unique_views
from certkit.reporting.text_table import show

if TYPE_CHECKING:
    from pathlib import Path

SAID = (
    "Points (euro-ncap-2026): femur 1 of 1 (green, F1 222.3 N·m); "
    "knee and tibia 0.75 of 1 (yellow, MCL 27.41 mm)"
)


def score(name: str, points: float, colour: str, criterion: str, value: float, unit: str) -> ScoreResult:
    return ScoreResult(
        id=name,
        points=points,
        maximum=1.0,
        criterion=criterion,
        value=value,
        unit=unit,
        full=27.0,
        zero=32.0,
        scheme="euro-ncap-2026",
        colour=colour,
        confidence="verified",
        source="a rating program",
    )


@pytest.fixture
def scored() -> Result:
    return result().model_copy(
        update={
            "scores": [
                score("femur", 1.0, "green", "F1", 222.3, "N·m"),
                score("knee and tibia", 0.75, "yellow", "MCL", 27.41, "mm"),
            ]
        }
    )


def test_terminal_and_markdown_say_them_in_one_line(scored: Result):
    stream = io.StringIO()
    show(unique_views([scored]), stream)
    assert SAID in stream.getvalue()
    assert SAID in summary(unique_views([scored]))
    assert "Points" not in summary(unique_views([result().model_copy(update={"scores": []})]))


def test_they_are_worded_in_the_readers_language(scored: Result):
    assert "grün" in unique_views([scored], "de")[0].points


def test_junit_has_them_as_properties_of_the_suite(scored: Result):
    suite = parsed(junit(unique_views([scored]))).find("testsuite")
    found = {entry.get("name"): entry.get("value") for entry in suite.find("properties")}
    assert found["score: knee and tibia"] == "0.75"
    assert found["score: knee and tibia, of"] == "1"
    assert found["score: knee and tibia, by"] == "MCL"
    assert found["score: knee and tibia, colour"] == "yellow"


def test_page_and_first_page_of_the_pdf_show_them(scored: Result, tmp_path: Path):
    assert SAID in page(unique_views([scored])[0])
    pdfium = pytest.importorskip("pypdfium2", reason="reads the PDF")
    from certkit.reporting.writing import render  # noqa: PLC0415  # Pango may be missing

    render(scored, tmp_path, ("pdf",))
    first = pdfium.PdfDocument(tmp_path / "report.pdf")[0].get_textpage().get_text_range()
    assert "knee and tibia 0.75 of 1" in " ".join(first.split())
