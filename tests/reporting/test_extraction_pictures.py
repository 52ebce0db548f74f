from __future__ import annotations

import json
import re
from html import unescape
from typing import TYPE_CHECKING, Any

import pytest
from pydantic import ValidationError
from support import synthetic_extraction
from support.synthetic_result import parsed

from certkit.documents.extraction import ExtractionResult
from certkit.documents.front_motion import MovingLine
from certkit.reporting.charts.extraction_charts import momentum_chart
from certkit.reporting.charts.group_response import contact
from certkit.reporting.charts.load_paths import sketches
from certkit.reporting.charts.paired_bars import bars_of
from certkit.reporting.charts.run_and_model import draw
from certkit.reporting.charts.spring_curves import spring_chart
from certkit.reporting.extraction_report import extraction_page
from certkit.reporting.extraction_text import check_sentence, left_out

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.reporting.svg import Drawing


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


def test_the_worst_group_and_the_worst_curve_come_first_with_their_pictures(html: str) -> None:
    assert '<h2 id="worst-group">Worst group: F2</h2>' in html
    assert html.index("F2 moves") < html.index("F1 moves")
    worst = html.index("<b>Worst curve.</b>")
    assert html.rindex(">Tibia moment 1<", 0, worst) > 0
    assert worst < html.index(">MCL elongation<", worst)


def test_a_gauge_is_not_called_by_a_faces_name(html: str) -> None:
    keys = re.findall(r'class="(?:key|title)"[^>]*>([^<]+)<', html)
    assert "Femur moment 1" in keys
    assert {"F1", "F2"} <= set(keys)
    assert not any(re.fullmatch(r"T\d", words) for words in keys)


def test_a_spring_that_went_farther_than_the_run_showed_is_shaded(extraction: ExtractionResult) -> None:
    paths = {path.name: path for path in extraction.paths}
    assert 'class="guard"' in str(spring_chart(extraction, paths["F2 – E1"]))
    assert 'class="guard"' not in str(spring_chart(extraction, paths["E1 – ground"]))


def test_both_branches_of_a_spring_and_of_its_law_are_drawn(extraction: ExtractionResult) -> None:
    path = next(path for path in extraction.paths if path.name == "F2 – E1")
    drawn = parsed(str(spring_chart(extraction, path)))
    curves = [
        e for e in drawn.iter() if e.tag.endswith("path") and (e.get("class") or "").startswith("curve")
    ]
    assert len({(e.get("stroke"), e.get("stroke-dasharray")) for e in curves}) == 4
    assert "run, run, back, law, model" in (drawn.get("aria-label") or "")


def test_paths_are_as_broad_as_their_impulses_in_run_and_model(extraction: ExtractionResult) -> None:
    def breadths(drawing: Drawing) -> dict[str, float]:
        found = {}
        for e in parsed(str(drawing)).iter():
            told = [child.text or "" for child in e if child.tag.endswith("title")]
            if e.get("stroke-width") and told:
                found[told[0].split(":")[0]] = float(e.get("stroke-width") or 0)
        return found

    run, model = (breadths(drawing) for drawing in sketches(extraction))
    assert run.keys() <= model.keys()
    assert model["F2 – E1"] > model["E1 – ground"]
    assert model["leg – F1"] == pytest.approx(model["leg – F2"])  # both took 22 N·s


def test_bars_say_their_values_and_stand_in_the_order_of_height(extraction: ExtractionResult) -> None:
    said = bars_of(extraction)[0].title
    assert said.endswith("N·s: F2 20 and 22; F1 20 and 22")


def test_no_two_groups_share_a_line_style(extraction: ExtractionResult) -> None:
    many = tuple(
        extraction.groups[1].model_copy(update={"name": f"G{k}", "kind": ("a", "b")[k % 2]})
        for k in range(15)
    )
    drawn = parsed(str(momentum_chart(extraction.model_copy(update={"groups": many}))))
    styles = [
        (e.get("stroke"), e.get("stroke-dasharray"))
        for e in drawn.iter()
        if e.tag.endswith("path") and (e.get("class") or "").startswith("curve")
    ]
    assert len(styles) == len(set(styles)) == 15
    assert len({dash for _, dash in styles}) == 15


def test_permanent_set_is_a_share_of_the_largest_shortening(html: str) -> None:
    assert "permanent set 30 % of the largest shortening" in html


def test_the_front_alone_is_shown_where_the_impactor_was_no_leg(extraction: ExtractionResult) -> None:
    front = extraction.model_copy(update={"checks": extraction.checks[:1], "motion": None})
    html = extraction_page(front)
    assert "Worst group: F2" in html
    assert "front alone" in html
    assert "Moments and ligaments" not in html


def test_the_contact_alone_is_drawn_beside_run_and_model(extraction: ExtractionResult, html: str) -> None:
    drawn = contact(extraction, "F2")
    assert drawn is not None
    assert "contact alone" in drawn.body
    row = html.partition('<tr><th scope="row">The contact alone')[2].partition("</tr>")[0]
    assert "F2&nbsp;29.0&nbsp;%" in row
    check = next(check for check in extraction.checks if check.id == "contact alone")
    assert "F2 is pressed on with 2.9 kN, in the run 3.2 kN (29 % rms); contact force +4.0 %" in (
        check_sentence(check)
    )
    assert left_out(extraction) is None


def test_a_run_that_does_not_tell_how_its_leg_moved_says_so(extraction: ExtractionResult) -> None:
    checks = tuple(check for check in extraction.checks if check.id != "contact alone")
    without = extraction.model_copy(update={"checks": checks}).with_id()
    said = left_out(without)
    assert said is not None
    assert said in unescape(extraction_page(without))


def test_the_bars_beside_the_leg_are_the_contact_forces_of_the_document(
    extraction: ExtractionResult, html: str
) -> None:
    motion = embedded(html)["motion"]
    line = next(line for line in motion["lines"] if line["name"] == "F2")
    path = next(path for path in extraction.paths if path.name == "leg – F2")
    assert line["run"]["forces"] == pytest.approx(path.force, rel=0.01, abs=60)
    assert max(line["model"]["forces"]) == pytest.approx(1.1 * max(line["run"]["forces"]), rel=0.01)
    left, scale, measure = motion["bars"]
    assert motion["box"][0] < left < left + scale * measure < -0.06  # left of the leg


def test_links_at_the_top_lead_to_what_is_there(html: str) -> None:
    targets = re.findall(r'<a href="#([a-z-]+)">', html[: html.index("Held to the run")])
    assert len(targets) > 8
    assert all(f'id="{target}"' in html for target in targets if target != "main")


def test_long_names_of_groups_are_cut_where_they_have_no_room(extraction: ExtractionResult) -> None:
    long = "upper crossmember of the front end"
    text = extraction.to_json().replace('"E1', f'"{long}').replace("– E1", f"– {long}")
    named = ExtractionResult.from_json(text)
    for drawing in (*sketches(named), *bars_of(named)):
        shown = [e.text or "" for e in parsed(str(drawing)).iter() if e.tag.endswith("text")]
        assert (
            any(words.endswith("…") and long.startswith(words[:8]) for words in shown)
            or long not in drawing.title
        )
        assert all(len(words) <= 40 for words in shown)
    assert long in extraction_page(named)
