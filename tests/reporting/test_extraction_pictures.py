from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

import pytest
from pydantic import ValidationError
from support import synthetic_extraction
from support.synthetic_result import parsed

from certkit.documents.extraction import ExtractionResult
from certkit.documents.front_motion import MovingLine
from certkit.reporting.charts.run_and_model import draw
from certkit.reporting.extraction_report import extraction_page

if TYPE_CHECKING:
    from collections.abc import Sequence


@pytest.fixture(scope="module")
def extraction() -> ExtractionResult:
    return synthetic_extraction.extraction()


@pytest.fixture(scope="module")
def html(extraction: ExtractionResult) -> str:
    return extraction_page(extraction)


def embedded(html: str) -> Any:  # noqa: ANN401  # what the page holds
    found = re.search(r"<script type=\"application/json\" data-result>(.*?)</script>", html, re.DOTALL)
    assert found
    return json.loads(found[1])


def summed(steps: Sequence[int]) -> list[int]:
    total, found = 0, []
    for step in steps:
        total += step
        found.append(total)
    return found


def test_the_page_moves_the_points_of_the_document(extraction: ExtractionResult, html: str) -> None:
    assert extraction.motion
    shown = embedded(html)["motion"]
    for line, wanted in zip(shown["lines"], extraction.motion.lines, strict=True):
        for side, frames in (("run", wanted.run), ("model", wanted.model)):
            columns = [summed(summed(column)) for column in line[side]["places"]]
            for column, places in zip(
                columns, zip(*([v for p in f for v in p] for f in frames), strict=True), strict=True
            ):
                assert [v * shown["unit"] for v in column] == pytest.approx(places, abs=0.51e-4)


def test_the_worst_group_is_marked_in_motion(html: str) -> None:
    marked = [line["name"] for line in embedded(html)["motion"]["lines"] if line.get("marked")]
    assert marked == ["F2"]


def test_the_same_document_gives_the_same_page(extraction: ExtractionResult, html: str) -> None:
    assert extraction_page(ExtractionResult.from_json(extraction.to_json())) == html


def test_a_document_without_motion_and_checks_still_has_a_page(extraction: ExtractionResult) -> None:
    old = extraction.model_copy(update={"motion": None, "checks": ()})
    html = extraction_page(old)
    assert "data-player" not in html
    assert "<script" not in html
    assert draw(old, []) is None


def test_what_a_document_has_not_does_not_change_its_id(extraction: ExtractionResult) -> None:
    old = extraction.model_copy(update={"motion": None})
    written = json.loads(old.to_json())
    assert written.pop("motion") is None
    assert ExtractionResult.from_json(json.dumps(written)).content_id() == old.content_id()


def test_a_line_that_loses_a_point_is_refused(extraction: ExtractionResult) -> None:
    document = json.loads(extraction.to_json())
    document["motion"]["lines"][0]["run"][3].pop()
    with pytest.raises(ValidationError, match=r"leg: run\.3"):
        ExtractionResult.model_validate_json(json.dumps(document))


def test_leg_and_faces_stand_side_by_side_on_paper(extraction: ExtractionResult) -> None:
    words = [e.text for e in parsed(str(draw(extraction, []))).iter() if e.tag.endswith("text")]
    assert {"run", "model", "0 ms", "45 ms"} <= set(words)


def test_a_side_that_is_not_known_is_left_out(extraction: ExtractionResult) -> None:
    assert extraction.motion
    alone = MovingLine(
        name="E9", kind="inside", model=[[(0.0, 0.0), (0.1, 0.0)]] * len(extraction.motion.times)
    )
    motion = extraction.motion.model_copy(update={"lines": (*extraction.motion.lines, alone)})
    line = embedded(extraction_page(extraction.model_copy(update={"motion": motion})))["motion"]["lines"][-1]
    assert "run" not in line
    assert line["model"]["places"]
