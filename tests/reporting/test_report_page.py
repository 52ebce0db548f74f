from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from typing import Any

import pytest
from support import synthetic_result

from certkit.documents.result import Result
from certkit.reporting.html_report import page, suite_page
from certkit.reporting.page_data import differences, payload
from certkit.reporting.result_view import unique_views, view


def embedded(html: str) -> list[dict[str, Any]]:
    blocks = re.findall(r'<script type="application/json" data-result>(.*?)</script>', html, re.DOTALL)
    return [json.loads(block) for block in blocks]


class Anatomy(HTMLParser):
    """What a page refers to and what it could run."""

    def __init__(self) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.addresses: list[str] = []
        self.handlers: list[str] = []
        self.scripts = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]):
        values = dict(attrs)
        self.ids += [values["id"]] if values.get("id") else []
        self.handlers += [name for name in values if name.startswith("on") or name == "style"]
        if tag == "script" and values.get("type") != "application/json":
            self.scripts += 1
        if tag == "a":
            self.links.append(values["href"])
        self.addresses += [
            v for k, v in values.items() if k in {"src", "href", "action", "data"} and tag != "a" and v
        ]


def page_of(result: Result) -> str:
    return page(view(result))


def suite_of(results: list[Result]) -> str:
    return suite_page(unique_views(results))


def anatomy(html: str) -> Anatomy:
    parser = Anatomy()
    parser.feed(html)
    return parser


def test_the_verdict_stands_before_everything_else(pendulum: Result):
    html = page_of(pendulum)
    assert html.index("<strong>pass</strong>") < html.index("<h2")


def test_recalled_corridors_are_said_beside_the_verdict(pendulum: Result):
    verdict = re.search(r'<section class="verdict.*?</section>', page_of(pendulum), re.DOTALL)
    assert verdict
    assert "not verified against the regulation&#39;s text" in verdict.group()


def test_every_criterion_stands_in_the_table_with_value_and_corridor(pendulum: Result):
    html = page_of(pendulum)
    for criterion in pendulum.criteria:
        assert f">{criterion.id}<" in html
    assert "235 – 272" in html
    assert "253.4" in html


def test_the_page_asks_for_nothing_and_runs_nothing_but_its_own_script(pendulum: Result):
    parts = anatomy(page_of(pendulum))
    assert all(address.startswith("data:") for address in parts.addresses)
    assert parts.handlers == []
    assert parts.scripts == 1


def test_the_policy_forbids_the_network(pendulum: Result):
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', page_of(pendulum))
    assert policy
    assert "default-src &#39;none&#39;" in policy.group(1)
    assert "http" not in policy.group(1)
    assert "unsafe" not in policy.group(1)


def test_links_inside_the_page_lead_somewhere_and_ids_are_unique(
    pendulum: Result, bending: Result, measured: Result
):
    parts = anatomy(suite_of([pendulum, bending, measured]))
    assert len(parts.ids) == len(set(parts.ids))
    assert {link[1:] for link in parts.links if link.startswith("#")} <= set(parts.ids)


ATTACK = "</script><script>alert(1)</script>{{ 7*7 }}<img src=x onerror=alert(1)>"


@pytest.mark.parametrize("field", ["title", "method", "decision_rule"])
def test_text_from_data_is_shown_and_never_run(field: str):
    html = page_of(synthetic_result.result(**{field: ATTACK}))
    assert "<script>alert(1)" not in html
    assert "<img src=x" not in html
    assert anatomy(html).scripts == 1
    assert embedded(html)[0]["procedure"] == "pendulum"


def test_channel_names_from_data_cannot_break_out_of_figures():
    document = synthetic_result.document()
    document["curves"]["series"][ATTACK] = document["curves"]["series"].pop("T1")
    document["motion"]["shapes"][0]["name"] = ATTACK
    html = page_of(Result.model_validate(document))
    assert anatomy(html).scripts == 1
    assert "<img src=x" not in html


def test_a_laboratory_logo_that_is_no_picture_is_left_out():
    html = page_of(
        synthetic_result.result(laboratory={"name": "L", "logo": "data:text/html;base64,PHNjcmlwdD4="})
    )
    assert "text/html;base64" not in html


def test_the_same_result_gives_the_same_bytes(pendulum: Result):
    assert page_of(pendulum) == page_of(synthetic_result.result())


def test_seven_procedures_in_one_file_stay_under_one_and_a_half_megabytes():
    names = [f"procedure {number}" for number in range(7)]
    html = suite_of([synthetic_result.result(procedure=name) for name in names])
    assert len(html.encode()) < 1_500_000


def test_the_suite_has_a_line_with_verdict_margin_and_curve_for_each_procedure(
    pendulum: Result, measured: Result
):
    html = suite_of([pendulum, measured])
    index = html[html.index("plain index") : html.index("<article")].replace("\u00a0", " ")
    assert index.count("<tr>") == 3
    assert "T4: 2.3 N·m inside 90 – 111" in index
    assert "T4: 1.4 N·m outside 90 – 111" in index
    assert index.count('class="spark"') == 2


def test_the_same_procedure_twice_gets_two_chapters(pendulum: Result):
    parts = anatomy(suite_of([pendulum, pendulum]))
    assert {"pendulum", "pendulum-2"} <= set(parts.ids)


def test_steps_add_up_to_the_numbers_they_came_from():
    numbers = [5, 5, 7, -3, 0]
    total, found = 0, []
    for step in differences(numbers):
        total += step
        found.append(total)
    assert found == numbers


def test_the_embedded_curves_are_those_of_the_document(pendulum: Result):
    data = payload(pendulum)
    channel = next(c for c in data["channels"] if c["name"] == "T1")
    total = 0
    for step, wanted in zip(channel["steps"], pendulum.curves.series["T1"].values, strict=True):
        total += step
        assert total / 10 ** (channel["decimals"] + 1) == pytest.approx(wanted, abs=0.006)


def test_poses_travel_within_a_tenth_of_a_millimetre(pendulum: Result):
    motion = payload(pendulum)["motion"]
    column = motion["poses"][3]  # x of the second shape
    speed = place = 0
    for frame, step in enumerate(column):
        speed += step
        place += speed
        assert place * motion["unit"] == pytest.approx(pendulum.motion.poses[frame][1][0], abs=1e-4)


def test_a_result_with_nothing_but_a_verdict_still_makes_a_page():
    bare = synthetic_result.result(
        criteria=[],
        scores=[],
        comparison=None,
        quality=None,
        energies=None,
        curves=None,
        channels=None,
        motion=None,
        parameters=[],
        interval=None,
        notes=[],
        verdict="not evaluated",
    )
    html = page_of(bare)
    assert "<strong>not evaluated</strong>" in html
    assert "No criterion could be graded" in html


def test_a_missing_value_is_a_dash_and_its_reason_is_given(measured: Result):
    html = page_of(measured)
    row = html[html.index('data-chart="pendulum-chart-ACL"') : html.index('data-chart="pendulum-chart-PCL"')]
    assert '<td class="n" data-label="Value"><b>–</b>' in row
    assert "channel ACL was not recorded" in row


def test_a_suite_says_its_overall_verdict_and_that_it_mixes_kinds_and_legforms(
    pendulum: Result, measured: Result
):
    other = measured.model_copy(update={"specimen": {"legform": "flex-pli-gtr", "serial": "GTR-0815"}})
    html = suite_of([pendulum, other])
    assert '<section class="verdict v-fail">' in html.split('class="plain index')[0]
    assert "This suite binds different kinds of tests: simulated test, measured test." in html
    assert "This suite binds tests of different legforms: flex-pli-gtr; flex-pli-gtr GTR-0815." in html
    alone = suite_of([pendulum, pendulum])
    assert "This suite binds" not in alone


def test_reports_of_a_suite_are_closed_until_the_index_leads_to_them(pendulum: Result, measured: Result):
    html = suite_of([pendulum, measured])
    assert html.count('<details class="chapter">') == 2
    assert html.count('<a href="#index">') == 2
