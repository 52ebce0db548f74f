"""A criterion in words, as every report shows it: a row of page, PDF and summary, a case of JUnit."""

from __future__ import annotations

import re
from functools import cached_property
from typing import TYPE_CHECKING

from msgspec import Struct

from certkit.reporting import number_format as words

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Sequence

    from certkit.documents.result import CriterionResult
    from certkit.reporting.svg import Drawing

    Translate = Callable[..., str]
    """A language's fixed word for an English one: `certkit.reporting.language.Language.word`."""


class Row(Struct, frozen=True, dict=True):
    """A line of the criteria table, in words.

    Parameters
    ----------
    criterion : CriterionResult
        What it is about, for formats that take numbers.
    decimals : int
        With how many its value, limits and margin are written.
    name, title : str
        `T1 Tibia moment 1`, and what the title says beyond the id.
    value, unit, limits, margin, time : str
        Numbers as the field writes them, a dash where there is none; time in ms, limits as `235 – 272`.
    corridor : str
        The limits, or what stands for them: a polygon, a band over time.
    spread : str
        Smallest and largest value over a family of legs, with mean and standard deviation.
    verdict, sign : str
        Of the document, and a sign for it.
    source_number : int or None
        Its source's place among the sources of the result.
    how : str
        How it is measured: measure and filter.
    unsure : list of str
        Uncertainties, and spread over a family.
    outcome : str
        One line: `T4: 112.4 N·m outside 90 – 111 by 1.4 N·m`.
    chart : str or None
        Key of the figure that shows it.
    """

    criterion: CriterionResult
    decimals: int
    name: str
    title: str
    value: str
    unit: str
    limits: str
    corridor: str
    margin: str
    spread: str
    time: str
    verdict: str
    sign: str
    confidence: str
    source_number: int | None
    how: str
    unsure: list[str]
    outcome: str
    chart: str | None

    @property
    def id(self) -> str:
        """Name of the criterion, such as `T1`."""
        return self.criterion.id

    @property
    def graded(self) -> bool:
        """Whether it counts for the verdict."""
        return self.criterion.graded

    @property
    def reason(self) -> str:
        """Why it has this verdict, or no value."""
        return self.criterion.reason

    @cached_property
    def bar(self) -> Drawing | None:
        """Where the value lies in its corridor, drawn; None without a value or limits."""
        from certkit.reporting.charts.position import position_bar  # noqa: PLC0415  # text needs no drawings

        return position_bar(self.criterion, self.decimals)


def criterion_row(
    criterion: CriterionResult, key: str, drawn: Collection[str], sources: Sequence[str], t: Translate
) -> Row:
    """Word a criterion.

    Parameters
    ----------
    criterion : CriterionResult
        With its reason worded.
    key : str
        Of the result, for links.
    drawn : collection of str
        What there are figures of; see `figure_of`.
    sources : sequence of str
        All sources of the result's corridors.
    t : callable
        Gives a fixed word in the language.
    """
    decimals = words.criterion_decimals(criterion)
    figure = figure_of(criterion)
    limits = words.corridor(criterion.lower, criterion.upper)
    how = " · ".join(part for part in (t(criterion.measure), criterion.filter) if part and part != "none")
    return Row(
        criterion=criterion,
        decimals=decimals,
        name=words.named(criterion.id, criterion.title),
        title=words.rest(criterion.id, criterion.title),
        value=words.fixed(criterion.value, decimals),
        unit=criterion.unit if criterion.value is not None else "",
        limits=limits,
        corridor=_corridor(criterion, limits, t),
        margin=words.fixed(criterion.margin, decimals),
        spread=_spread(criterion, decimals),
        # A curve in a plane runs over loads, not over time.
        time=words.MISSING if criterion.curve else words.milliseconds(criterion.time),
        verdict=criterion.verdict if criterion.graded else "informative",
        sign=words.SIGNS[criterion.verdict] if criterion.graded else "·",
        confidence=criterion.confidence or "",
        source_number=sources.index(criterion.source) + 1 if criterion.source else None,
        how=how,
        unsure=_unsure(criterion, decimals, t),
        outcome=_outcome(criterion, decimals, limits, t),
        chart=f"{key}-chart-{slug(figure)}" if figure in drawn else None,
    )


def figure_of(criterion: CriterionResult) -> str:
    """Return which figure shows a criterion: that of its channel, or of its own curve in a plane."""
    return f"plane {criterion.id}" if criterion.curve else criterion.channel


def slug(text: str) -> str:
    """Return `text` as part of an HTML id and of a file name."""
    return re.sub(r"[^A-Za-z0-9]+", "-", text).strip("-") or "x"


def _corridor(criterion: CriterionResult, limits: str, t: Translate) -> str:
    if criterion.lower is None and criterion.upper is None:
        if criterion.curve and criterion.curve.polygon:
            return t("polygon")
        return t("over time") if criterion.band else words.MISSING
    return limits


def _spread(criterion: CriterionResult, decimals: int) -> str:
    spread = criterion.spread
    if spread is None:
        return words.MISSING
    low, high, mean, deviation = (
        words.fixed(v, decimals)
        for v in (spread.minimum, spread.maximum, spread.mean, spread.standard_deviation)
    )
    share = "" if spread.passing is None else f", {100 * spread.passing:.0f} % pass"
    return f"{low} to {high}, {mean} ± {deviation}{share}"


def _outcome(criterion: CriterionResult, decimals: int, limits: str, t: Translate) -> str:
    if criterion.value is None:
        return f"{criterion.id}: {criterion.verdict}; {criterion.reason or 'no value'}"
    said = f"{criterion.id}: {words.fixed(criterion.value, decimals)} {criterion.unit}"
    margin = criterion.margin
    if margin is not None and (criterion.lower is not None or criterion.upper is not None):
        side = t("inside") if margin >= 0 else t("outside")
        said += f" {side} {limits} by {words.fixed(abs(margin), decimals)}"
    return f"{said}; {criterion.reason}" if criterion.reason else said


def _unsure(criterion: CriterionResult, decimals: int, t: Translate) -> list[str]:
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
        remarks += [f"± {words.significant(v, 2)} {name}" for name, v in parts if v]
        if unsure.false_accept is not None:
            share = unsure.false_accept * 100
            remarks.append(
                f"{t('false accept')} {words.significant(share, 2) if share >= 0.01 else '< 0.01'} %"
            )
    if criterion.spread:
        spread = criterion.spread
        low, high = (words.fixed(v, decimals) for v in (spread.minimum, spread.maximum))
        remarks.append(t("{low} – {high} over {legs} legs", low=low, high=high, legs=spread.members))
        remarks.append(f"{t('standard deviation')} {words.significant(spread.standard_deviation, 2)}")
        if spread.passing is not None:
            remarks.append(t("{percent} % of the legs pass", percent=f"{100 * spread.passing:.0f}"))
    return remarks
