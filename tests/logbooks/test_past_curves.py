"""The last ten curves of each channel over a legform's tests, and its scatter beside a published one."""

from __future__ import annotations

from pathlib import Path

import pytest
from support import synthetic_result
from support.worn_leg import worn

from certkit.documents.logbook_overview import LegOverview
from certkit.logbooks import Logbook, add, overview
from certkit.logbooks.past_curves import MOST_POINTS, MOST_TESTS
from certkit.reporting.charts.past_curves_chart import past_curves_chart
from certkit.reporting.language import language
from certkit.reporting.logbook_page import logbook_page


@pytest.fixture(scope="module")
def leg(tmp_path_factory: pytest.TempPathFactory) -> LegOverview:
    folder = tmp_path_factory.mktemp("worn")
    paths = []
    for place, result in enumerate(worn(synthetic_result.laboratory_result())):
        paths.append(folder / f"{place}.json")
        result.write(paths[-1])
    book = Logbook(folder / "book")
    add(book, paths)
    return overview(book, "GTR-0815", curves=True)


def test_the_last_ten_curves_of_each_channel_are_kept(leg: LegOverview):
    past = next(each for each in leg.curves if each.criterion == "T1")
    assert len(leg.tests) == 12
    assert [curve.id for curve in past.curves] == [test.id for test in leg.tests[-MOST_TESTS:]]
    assert (past.lower, past.upper) == (235.0, 272.0)


def test_a_thinned_curve_keeps_its_highest_and_its_lowest_value(leg: LegOverview):
    tests = worn(synthetic_result.laboratory_result())[-MOST_TESTS:]
    drawn = [result.as_written().curves for result in tests]
    for past in leg.curves:
        for curve, curves in zip(past.curves, drawn, strict=True):
            whole = curves.series[past.criterion].values
            heights = [y for _, y in curve.points]
            assert len(heights) <= MOST_POINTS + 3
            assert (min(heights), max(heights)) == (min(whole), max(whole))


def test_the_last_curve_is_drawn_last_and_in_colour(leg: LegOverview):
    drawing = synthetic_result.parsed(past_curves_chart(leg.curves[0], language()))
    curves = [
        each.get("class") for each in drawing.iter() if (each.get("class") or "") in {"zero", "curve p0"}
    ]
    assert curves[-1] == "curve p0"
    assert curves.count("curve p0") == 1
    assert "corridor" in {each.get("class") for each in drawing.iter()}


def test_scatter_stands_beside_the_published_one(leg: LegOverview):
    trend = next(each for each in leg.trends if each.criterion == "T1")
    assert trend.variation_percent == pytest.approx(1.45, abs=0.1)
    assert trend.published_percent == 4.0
    assert "NHTSA" in trend.published_source
    page = logbook_page([leg])
    assert "Last curves" in page
    assert "exceeded" not in page


def test_without_being_asked_for_no_documents_are_read(tmp_path: Path):
    result = worn(synthetic_result.laboratory_result(), tests=1)[0]
    result.write(tmp_path / "0.json")
    book = Logbook(tmp_path / "book")
    add(book, [tmp_path / "0.json"])
    assert overview(book, "GTR-0815").curves == []
