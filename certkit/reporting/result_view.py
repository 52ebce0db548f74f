"""What the templates of page and certificate show: the result's parts, worded and drawn once for both."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.reporting import number_format as words
from certkit.reporting.charts.channel_history import history_chart
from certkit.reporting.charts.error_bars import errors_chart
from certkit.reporting.charts.lines import energies_chart
from certkit.reporting.charts.motion_frames import frames_chart
from certkit.reporting.charts.plane import plane_chart
from certkit.reporting.charts.position import position_bar
from certkit.reporting.charts.spark import sparkline
from certkit.reporting.laboratory_view import LaboratoryView, laboratory_view
from certkit.reporting.language import ENGLISH, language, worded
from certkit.reporting.margins import margin_words, nearest_words, tally, worst

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from certkit.documents.result import CriterionResult, Result
    from certkit.reporting.svg import Drawing

KINDS = {
    "virtual certification": ("Virtual certification of the model", "simulated test"),
    "test evaluation": ("Test evaluation", "measured test"),
}


@dataclass(frozen=True)
class Row:
    """A line of the criteria table, in words."""

    id: str
    title: str
    value: str
    unit: str
    corridor: str
    bar: Drawing | None
    margin: str
    time: str
    verdict: str
    sign: str
    graded: bool
    confidence: str
    source_number: int | None
    how: str
    unsure: list[str]
    reason: str
    chart: str | None


@dataclass(frozen=True)
class LinkedDrawing:
    """A figure with the key that links point to."""

    key: str
    name: str
    svg: Drawing
    criterion: str | None = None


@dataclass(frozen=True)
class NumberGroup:
    """Numbers that went in from one file: (name, value, confidence, number of the source)."""

    title: str
    rows: list[tuple[str, str, str, int]]


@dataclass(frozen=True)
class View:
    """A result, ready for the templates."""

    result: Result
    key: str
    heading: str
    subject: str
    meaning: str
    tally: str
    nearest: str
    nearest_words: str
    rows: list[Row]
    sources: list[str]
    histories: list[LinkedDrawing]
    planes: list[LinkedDrawing]
    spark: Drawing | None
    frames: Drawing | None
    errors: Drawing | None
    energies: Drawing | None
    laboratory: LaboratoryView | None
    specimen: list[tuple[str, str]]
    numbers: list[NumberGroup]
    number_sources: list[str]

    @property
    def confidences(self) -> list[tuple[str, int]]:
        """Return how many numbers that went in have each confidence."""
        counts = dict.fromkeys(words.CONFIDENCE, 0)
        for parameter in self.result.parameters:
            counts[parameter.confidence] += 1
        return [(word, count) for word, count in counts.items() if count]


def slug(text: str) -> str:
    """Return `text` as part of an HTML id and of a file name."""
    return re.sub(r"[^A-Za-z0-9]+", "-", text).strip("-") or "x"


def _unsure(criterion: CriterionResult, decimals: int, t: Callable[..., str]) -> list[str]:
    remarks: list[str] = []
    unsure = criterion.uncertainty
    if unsure:
        finest = 10.0**-decimals
        if unsure.numerical is not None and abs(unsure.numerical) < finest / 2:
            remarks.append(f"± < {words.plain(finest)} {t('numerical')}")
        parts = (
            (t("numerical"), unsure.numerical if abs(unsure.numerical or 0) >= finest / 2 else None),
            ("U, k = 2", unsure.expanded),
            (t("guard band"), unsure.guard_band),
        )
        remarks += [f"± {words.plain(v, 2)} {name}" for name, v in parts if v]
        if unsure.false_accept is not None:
            share = unsure.false_accept * 100
            remarks.append(f"{t('false accept')} {words.plain(share, 2) if share >= 0.01 else '< 0.01'} %")
    if criterion.spread:
        spread = criterion.spread
        low, high = (words.fixed(v, decimals) for v in (spread.minimum, spread.maximum))
        remarks.append(t("{low} – {high} over {legs} legs", low=low, high=high, legs=spread.members))
        remarks.append(f"{t('standard deviation')} {words.plain(spread.standard_deviation, 2)}")
        if spread.passing is not None:
            remarks.append(t("{percent} % of the legs pass", percent=f"{100 * spread.passing:.0f}"))
    return remarks


def _row(
    criterion: CriterionResult, key: str, drawn: set[str], sources: list[str], t: Callable[..., str]
) -> Row:
    decimals = words.criterion_decimals(criterion)
    target = _target(criterion)
    how = " · ".join(part for part in (t(criterion.measure), criterion.filter) if part and part != "none")
    return Row(
        id=criterion.id,
        title=words.rest(criterion.id, criterion.title),
        value=words.fixed(criterion.value, decimals),
        unit=criterion.unit if criterion.value is not None else "",
        corridor=_corridor(criterion, t),
        bar=position_bar(criterion, decimals),
        margin=words.fixed(criterion.margin, decimals),
        time=words.milliseconds(criterion.time),
        verdict=criterion.verdict if criterion.graded else "informative",
        sign=words.SIGNS[criterion.verdict] if criterion.graded else "·",
        graded=criterion.graded,
        confidence=criterion.confidence or "",
        source_number=sources.index(criterion.source) + 1 if criterion.source else None,
        how=how,
        unsure=_unsure(criterion, decimals, t),
        reason=criterion.reason,
        chart=f"{key}-chart-{slug(target)}" if target in drawn else None,
    )


def _numbers(result: Result, sources: list[str]) -> list[NumberGroup]:
    """Group the numbers that went in by the file before the colon of their path."""
    groups: dict[str, list[tuple[str, str, str, int]]] = {}
    for number in result.parameters:
        file, colon, name = number.path.partition(": ")
        row = (
            name if colon else number.path,
            number.value,
            number.confidence,
            sources.index(number.source) + 1,
        )
        groups.setdefault(file if colon else "", []).append(row)
    return [NumberGroup(title, rows) for title, rows in groups.items()]


def _corridor(criterion: CriterionResult, t: Callable[..., str]) -> str:
    if criterion.lower is None and criterion.upper is None:
        if criterion.curve and criterion.curve.polygon:
            return t("polygon")
        return t("over time") if criterion.band else words.MISSING
    return words.corridor(criterion.lower, criterion.upper)


def _target(criterion: CriterionResult) -> str:
    return f"plane {criterion.id}" if criterion.curve else criterion.channel


def ordered_channels(result: Result) -> dict[str, CriterionResult | None]:
    """Return the channels to draw: those of criteria first, in the criteria's order, then the others."""
    if result.curves is None:
        return {}
    series = result.curves.series
    chosen: dict[str, CriterionResult | None] = {}
    for criterion in result.criteria:
        if criterion.channel in series and (criterion.channel not in chosen):
            chosen[criterion.channel] = criterion
    return chosen | {name: None for name in series if name not in chosen}


def view(result: Result, *, suffix: str = "", spoken: str = ENGLISH) -> View:
    """Word and draw a result in a language; `suffix` tells two results of one procedure apart."""
    t = language(spoken).word
    if spoken != ENGLISH:
        result = worded(result, spoken)
    key = slug(result.procedure) + suffix
    channels = ordered_channels(result)
    curves = result.curves
    drawable = curves is not None and curves.count > 1
    histories = (
        [
            LinkedDrawing(
                f"{key}-chart-{slug(name)}",
                name,
                history_chart(curves, name, c),
                c.id if c is not None else None,
            )
            for name, c in channels.items()
        ]
        if curves is not None and drawable
        else []
    )
    planes = [
        LinkedDrawing(f"{key}-chart-{slug(_target(c))}", c.id, plane_chart(c.curve, c.title), c.id)
        for c in result.criteria
        if c.curve
    ]
    targets = {_target(c) for c in result.criteria if c.curve} | (set(channels) if drawable else set())
    sources = list(dict.fromkeys(c.source for c in result.criteria if c.source))
    number_sources = list(dict.fromkeys(p.source for p in result.parameters))
    nearest = worst(result)
    heading, subject = KINDS[result.kind]
    return View(
        result=result,
        key=key,
        heading=t(heading),
        subject=t(subject),
        meaning=t(words.meaning(result.verdict)) if result.verdict in {"not evaluated", "error"} else "",
        tally=tally(result, language(spoken)),
        nearest=margin_words(nearest, language(spoken)),
        nearest_words=nearest_words(nearest, language(spoken)),
        rows=[_row(criterion, key, targets, sources, t) for criterion in result.criteria],
        sources=sources,
        histories=histories,
        planes=planes,
        spark=sparkline(result, nearest),
        frames=frames_chart(result.motion) if result.motion and result.motion.poses else None,
        errors=errors_chart(result.comparison) if result.comparison and result.comparison.rows else None,
        energies=energies_chart(result.energies) if result.energies else None,
        laboratory=laboratory_view(result.laboratory),
        specimen=[(t(name), value) for name, value in result.specimen.items()],
        numbers=_numbers(result, number_sources),
        number_sources=number_sources,
    )


def unique_views(results: Sequence[Result], spoken: str = ENGLISH) -> list[View]:
    """Return views whose keys differ, also when a procedure was run twice."""
    counts: dict[str, int] = {}
    views = []
    for result in results:
        counts[result.procedure] = counts.get(result.procedure, 0) + 1
        number = counts[result.procedure]
        views.append(view(result, suffix=f"-{number}" if number > 1 else "", spoken=spoken))
    return views
