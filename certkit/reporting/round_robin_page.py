"""A round robin as a page and as text, from its document alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import number_format as words
from certkit.reporting.charts.laboratory_values import laboratory_values_chart
from certkit.reporting.language import ENGLISH, language, worded
from certkit.reporting.plaintext import aligned
from certkit.reporting.static_page import static_page

if TYPE_CHECKING:
    from certkit.documents.round_robin_report import CriterionPrecision, RoundRobinReport
    from certkit.reporting.language import Translate

QUESTIONABLE, TOO_FAR = 2.0, 3.0
"""|z| from which a result is a warning, and an action signal (ISO 13528:2022, 9.4.2)."""


def round_robin_page(document: RoundRobinReport, spoken: str = ENGLISH) -> str:
    """Return the page."""
    shown = worded(document, spoken) if spoken != ENGLISH else document
    t = language(spoken).word
    scores = [
        (each, [_score(each, laboratory, t) for laboratory in document.laboratories])
        for each in document.criteria
    ]
    drawings = [laboratory_values_chart(each, language(spoken)) for each in document.criteria]
    outliers = [
        t(
            "{laboratory} in {criterion} ({test})",
            laboratory=each.laboratory,
            criterion=each.criterion,
            test=t(each.test),
        )
        for each in document.found_outliers
    ]
    return static_page(
        "round-robin.html.j2",
        document.title,
        spoken=spoken,
        doc=shown,
        scores=scores,
        drawings=drawings,
        outliers=outliers,
    )


def _score(criterion: CriterionPrecision, laboratory: str, t: Translate) -> tuple[float | None, str, str]:
    """Return z of a laboratory, the verdict whose colour it takes, and the outlier tests it fell in."""
    row = next((row for row in criterion.rows if row.laboratory == laboratory), None)
    if row is None or row.z is None:
        return None, "not evaluated", ""
    size = abs(row.z)
    verdict = "fail" if size >= TOO_FAR else "conditional" if size >= QUESTIONABLE else "pass"
    marks = (f"{t(what)}: {t(mark)}" for what, mark in row.marks if mark)
    return row.z, verdict, ", ".join(marks)


def round_robin_text(document: RoundRobinReport) -> str:
    """Return precision and outliers for a terminal."""
    heads = ("criterion", "labs", "tests", "mean", "s_r", "s_R", "unit", "farthest", "z", "")
    rows = [_row(each) for each in document.criteria]
    parts = [
        f"{document.title}: {len(document.tests)} tests of {len(document.laboratories)} laboratories",
        aligned(heads, rows, right=(1, 2, 3, 4, 5, 8)),
    ]
    if document.left_out:
        parts.append(f"left out: {', '.join(document.left_out)}")
    if document.outliers:
        parts.append("outliers: " + "; ".join(document.outliers))
    parts.append("\n".join(f"! {remark}" for remark in document.remarks))
    return "\n\n".join(part for part in parts if part)


def _row(each: CriterionPrecision) -> tuple[str, ...]:
    farthest = max(each.rows, key=lambda row: abs(row.z or 0.0))
    marks = sorted({mark for row in each.rows for mark in (row.cochran, row.grubbs) if mark})
    return (
        each.key,
        str(len(each.rows)),
        str(each.tests),
        words.shown(each.mean, each.unit),
        words.plain(each.repeatability, 3),
        words.plain(each.reproducibility, 3),
        each.unit,
        farthest.laboratory,
        words.fixed(farthest.z, 1),
        ", ".join(marks),
    )
