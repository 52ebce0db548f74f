"""What a leg's recordings tell of its parts, as a page and as text, from its document alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.files import write_whole
from certkit.reporting import number_format as words
from certkit.reporting.charts.lines import lines_chart
from certkit.reporting.plaintext import aligned
from certkit.reporting.static_page import static_page

if TYPE_CHECKING:
    from collections.abc import Collection
    from pathlib import Path

    from certkit.documents.twin_report import PartFinding, TwinCurve, TwinReport, TwinTest
    from certkit.reporting.svg import Drawing

SHOWN = 5
"""Parts that a terminal shows of each test."""


def render_twin(document: TwinReport, out: Path, formats: Collection[str]) -> list[Path]:
    """Write `twin.html` when it is wanted.

    Returns
    -------
    list of Path
        What was written.
    """
    if "html" not in formats:
        return []
    path = out / "twin.html"
    write_whole(path, twin_page(document))
    return [path]


def twin_page(document: TwinReport) -> str:
    """Return the page."""
    tests = [(test, said(test), [_drawing(curve) for curve in test.curves]) for test in document.tests]
    parts = list(dict.fromkeys(finding.part for test in document.tests for finding in test.findings))
    followed = [(part, [_of(test, part) for test in document.tests]) for part in parts]
    return static_page("twin.html.j2", document.title, doc=document, tests=tests, followed=followed)


def _of(test: TwinTest, part: str) -> PartFinding | None:
    return next((finding for finding in test.findings if finding.part == part), None)


def _drawing(curve: TwinCurve) -> Drawing:
    times = [1e3 * time for time in curve.time]
    lines = [("recorded", times, curve.recorded), ("model", times, curve.model)]
    lines.append(("with the best part", times, curve.changed))
    title = words.named(curve.channel, curve.title)
    return lines_chart(lines, title, "time after contact, ms", curve.unit)


def change(finding: PartFinding) -> str:
    """Return a part's change with its interval: `−7.9 % (−8.8 to −7.1)`."""
    low, high = words.plain(finding.lower, 2), words.plain(finding.upper, 2)
    return f"{words.plain(finding.change, 2)} {finding.unit} ({low} to {high})"


def said(test: TwinTest) -> str:
    """Return the answer of one test in words."""
    candidates = [finding for finding in test.findings if finding.candidate]
    if test.answer == "nothing deviates":
        return "No part deviates by more than sensors and time zero allow."
    if test.answer == "no part explains it":
        return f"No single part explains how it deviates; {candidates[0].part} comes nearest."
    if test.answer == "one part":
        return f"{candidates[0].part}: {change(candidates[0])}. What to do: {candidates[0].remedy}."
    told = "; or ".join(f"{finding.part}: {change(finding)}" for finding in candidates)
    return f"This recording cannot tell between {told}."


def twin_text(document: TwinReport) -> str:
    """Return each test's answer and its best parts for a terminal."""
    parts = [document.title]
    for test in document.tests:
        rows = [
            (
                finding.part,
                words.plain(finding.change, 2),
                finding.unit,
                f"{words.plain(finding.lower, 2)} to {words.plain(finding.upper, 2)}",
                f"{words.fixed(100 * finding.explained, 0)} %",
                words.plain(finding.misfit, 2),
            )
            for finding in test.findings[:SHOWN]
        ]
        heads = ("part", "change", "", "95 % interval", "explains", "left per sample")
        head = (
            f"{test.procedure} of {test.day}, {test.id}: deviation {words.plain(test.misfit, 2)} per sample"
        )
        parts += [f"{head}\n{said(test)}", aligned(heads, rows, right=(1, 4, 5))]
    return "\n\n".join([*parts, "\n".join(f"! {remark}" for remark in document.remarks)])
