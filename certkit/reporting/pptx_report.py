"""A result as slides (extra `pptx`): verdict, criteria, scores, and native charts of its channels."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.documents.unverified import is_marked
from certkit.reporting.scales import thinned
from certkit.reporting.slide_deck import SlideDeck

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.result import Histories
    from certkit.reporting.result_view import View
    from certkit.reporting.workbook import Cell

FILE = "report.pptx"
SUITE_FILE: str | None = "suite.pptx"
TRANSLATED = False
REPEATABLE = False  # its bytes depend on the template and on the version of python-pptx too

MOST_CHARTS = 3
STRIDE_TO = 200
"""Points of a curve on a slide, about."""


def write(views: Sequence[View], *, title: str | None, paper: str) -> bytes:
    """Return the slides of one result, or of a suite."""
    del paper
    deck = SlideDeck(next((view.document for view in views if is_marked(view.document)), None))
    if title is not None:
        rows: list[list[Cell]] = [
            [v.result.title, v.result.verdict, v.tally, v.nearest, v.result.id] for v in views
        ]
        deck.table(title, ("test", "verdict", "criteria", "nearest to its limit", "certificate"), rows)
    for view in views:
        _result(deck, view)
    return deck.content()


def _result(deck: SlideDeck, view: View) -> None:
    result = view.result
    verdict = f"{result.verdict.upper()}: {view.meaning or view.nearest_words}"
    deck.title(
        result.title, [verdict, view.tally, f"Certificate {result.id}, {result.kind}", *result.remarks]
    )
    rows: list[list[Cell]] = [
        [row.name, row.value, row.unit, row.limits, row.margin, row.verdict if row.graded else "shown only"]
        for row in view.rows
    ]
    deck.table(
        f"{result.title}: criteria", ("criterion", "value", "unit", "corridor", "margin", "verdict"), rows
    )
    if result.scores:
        scores: list[list[Cell]] = [
            [s.id, s.points, s.maximum, s.criterion, s.value, s.unit] for s in result.scores
        ]
        heads = ("score", "points", "maximum", "decided by", "value", "unit")
        deck.table(f"{result.title}: scores", heads, scores)
    if result.curves is not None:
        curve_slides(deck, result.title, result.curves)


def curve_slides(deck: SlideDeck, title: str, curves: Histories) -> None:
    """Add a chart a unit, with fewer points that keep the extremes of every channel."""
    times = curves.milliseconds
    units: dict[str, list[str]] = {}
    for name, series in curves.series.items():
        units.setdefault(series.unit, []).append(name)
    for unit, names in list(units.items())[:MOST_CHARTS]:
        kept = sorted(
            {
                time
                for name in names
                for time, _ in thinned(list(zip(times, curves.series[name].values, strict=True)), STRIDE_TO)
            }
        )
        places = {time: index for index, time in enumerate(times)}
        drawn = {name: [curves.series[name].values[places[t]] for t in kept] for name in names}
        deck.lines(f"{title}: channels in {unit}", kept, drawn, ("time after contact, ms", unit))
