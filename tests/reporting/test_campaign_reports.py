"""Everything that is made of a campaign document: text, page, table, JUnit."""

from __future__ import annotations

import csv
import io

import pytest
from support.synthetic_campaign import campaign
from support.synthetic_result import parsed

from certkit.documents.campaign_report import CampaignReport, JudgedCriterion
from certkit.documents.result import Verdict
from certkit.reporting.campaign_csv import campaign_csv
from certkit.reporting.campaign_junit import campaign_junit
from certkit.reporting.campaign_page import campaign_page
from certkit.reporting.campaign_text import campaign_text
from certkit.reporting.campaign_view import CampaignView, criterion_shade
from certkit.reporting.charts.car_front import car_front


@pytest.fixture(scope="module")
def document() -> CampaignReport:
    return campaign().as_written()


def test_the_text_has_a_line_a_point_and_a_line_a_scheme(document: CampaignReport):
    said = campaign_text(document)
    assert "✗ FAIL" in said.splitlines()[0]
    assert sum(line.startswith(("L", "=L")) for line in said.splitlines()) == 6
    assert "worst point L0, MCL at 105 %" in said
    assert "predicted against measured at 2 points" in said


def test_the_page_shows_every_point_and_runs_nothing_of_it(document: CampaignReport):
    page = campaign_page(document)
    assert "A &lt;made-up&gt; car" in page
    assert "<made-up>" not in page
    assert "<script" not in page
    for name in ("L-2", "L-1", "L0", "L+1", "L+2", "=L+3"):
        assert f"<b>{name}</b>" in page


@pytest.mark.parametrize(
    ("percent", "verdict", "shade"),
    [(89.0, "pass", "s1"), (91.0, "pass", "s2"), (99.0, "conditional", "s3"), (101.0, "fail", "s5")],
)
def test_a_value_is_shaded_by_its_verdict_and_from_90_percent_of_its_limit_on(
    percent: float, verdict: Verdict, shade: str
):
    row = JudgedCriterion(id="T1", unit="N·m", limit=340.0, percent=percent, verdict=verdict)
    assert criterion_shade(row) == shade


def test_the_car_carries_a_mark_a_point_in_its_place(document: CampaignReport):
    drawn = parsed(car_front(CampaignView(document), document.schemes[0]))
    space = "{http://www.w3.org/2000/svg}"
    marks = [each for each in drawn.iter(f"{space}a") if each.get("class") == "point"]
    names = [
        text.text for mark in marks for text in mark.iter(f"{space}text") if "name" in text.get("class", "")
    ]
    assert names == ["L-2", "L-1", "L0", "L+1", "L+2", "=L+3"]
    places = [float(next(mark.iter(f"{space}text")).get("x", "0")) for mark in marks]
    assert places == sorted(places)


def test_a_cell_of_the_table_begins_no_formula(document: CampaignReport):
    changed = document.model_copy(
        update={"points": [document.points[0].model_copy(update={"name": "L-2"}), *document.points[1:]]}
    )
    rows = list(csv.reader(io.StringIO(campaign_csv(changed))))
    assert len({len(row) for row in rows}) == 1
    assert not [cell for row in rows for cell in row if cell[:1] in "=+@" and cell]
    assert {row[0] for row in rows[1:]} == {"L-2", "L-1", "L0", "L+1", "L+2"}


def test_a_gate_sees_a_failure_a_point_and_the_total(document: CampaignReport):
    suites = {suite.get("name"): suite for suite in parsed(campaign_junit(document))}
    assert set(suites) == {
        "certkit.made-up.r127.limits",
        "certkit.made-up.euro-ncap-flex-pli.points",
        "certkit.made-up.r127.targets",
        "certkit.made-up.agreement",
    }
    limits = suites["certkit.made-up.r127.limits"]
    assert (limits.get("failures"), limits.get("errors")) == ("1", "1")
    failed = next(case for case in limits.iter("testcase") if case.find("failure") is not None)
    assert failed.get("name") == "L0"
    assert "MCL 23 mm, limit 22" in (failed.find("failure").get("message") or "")
    names = [
        case.get("name") for case in suites["certkit.made-up.euro-ncap-flex-pli.points"].iter("testcase")
    ]
    assert names[-1] == "total"
