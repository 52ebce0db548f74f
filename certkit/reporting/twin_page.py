"""What a leg's recordings tell of its parts, as a page and as text, from its document alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import number_format as words
from certkit.reporting.charts.lines import lines_chart
from certkit.reporting.language import ENGLISH, language, worded
from certkit.reporting.plaintext import aligned
from certkit.reporting.static_page import static_page
from certkit.reporting.translated_titles import title_in

if TYPE_CHECKING:
    from certkit.documents.twin_report import PartFinding, TwinCurve, TwinReport, TwinTest
    from certkit.reporting.language import Language
    from certkit.reporting.svg import Drawing

SHOWN = 5
"""Parts that a terminal shows of each test."""


def twin_page(document: TwinReport, spoken: str = ENGLISH) -> str:
    """Return the page."""
    shown = worded(document, spoken) if spoken != ENGLISH else document
    words_of = language(spoken)
    tests = [
        (test, said(test, words_of), [_drawing(curve, words_of) for curve in test.curves])
        for test in document.tests
    ]
    parts = list(dict.fromkeys(finding.part for test in document.tests for finding in test.findings))
    followed = [(part, [_of(test, part) for test in document.tests]) for part in parts]
    title = words_of.word("Twin of legform {serial}", serial=document.legform)
    title = title if spoken != ENGLISH else document.title
    return static_page("twin.html.j2", title, spoken=spoken, doc=shown, tests=tests, followed=followed)


def _of(test: TwinTest, part: str) -> PartFinding | None:
    return next((finding for finding in test.findings if finding.part == part), None)


def _drawing(curve: TwinCurve, spoken: Language) -> Drawing:
    times = [1e3 * time for time in curve.time]
    t = spoken.word
    lines = [(t("recorded"), times, curve.recorded), (t("model"), times, curve.model)]
    lines.append((t("with the best part"), times, curve.changed))
    title = words.named(curve.channel, title_in(curve.title, spoken))
    return lines_chart(lines, title, t("time after contact, ms"), curve.unit)


def change(finding: PartFinding, spoken: Language) -> str:
    """Return a part's change with its interval: `−7.9 % (−8.8 to −7.1)`."""
    low, high = words.significant(finding.lower, 2), words.significant(finding.upper, 2)
    ends = spoken.word("{low} to {high}", low=low, high=high)
    return f"{words.significant(finding.change, 2)} {finding.unit} ({ends})"


def said(test: TwinTest, spoken: Language) -> str:
    """Return the answer of one test in words."""
    t = spoken.word
    candidates = [finding for finding in test.findings if finding.candidate]
    if test.answer == "nothing deviates":
        return t("No part deviates by more than sensors and time zero allow.")
    if test.answer == "no part explains it":
        return t("No single part explains how it deviates; {part} comes nearest.", part=candidates[0].part)
    if test.answer == "one part":
        return t(
            "{part}: {change}. What to do: {remedy}.",
            part=candidates[0].part,
            change=change(candidates[0], spoken),
            remedy=candidates[0].remedy,
        )
    told = t("; or ").join(f"{finding.part}: {change(finding, spoken)}" for finding in candidates)
    return t("This recording cannot tell between {parts}.", parts=told)


def twin_text(document: TwinReport) -> str:
    """Return each test's answer and its best parts for a terminal."""
    parts = [document.title]
    for test in document.tests:
        rows = [
            (
                finding.part,
                words.significant(finding.change, 2),
                finding.unit,
                f"{words.significant(finding.lower, 2)} to {words.significant(finding.upper, 2)}",
                f"{words.fixed(100 * finding.explained, 0)} %",
                words.significant(finding.misfit, 2),
            )
            for finding in test.findings[:SHOWN]
        ]
        heads = ("part", "change", "", "95 % interval", "explains", "left per sample")
        misfit = words.significant(test.misfit, 2)
        head = f"{test.procedure} of {test.day}, {test.id}: deviation {misfit} per sample"
        parts += [f"{head}\n{said(test, language())}", aligned(heads, rows, right=(1, 4, 5))]
    return "\n\n".join([*parts, "\n".join(f"! {remark}" for remark in document.remarks)])
