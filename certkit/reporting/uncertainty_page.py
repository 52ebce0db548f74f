"""An uncertainty budget as a page and as text, from its document alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import number_format as words
from certkit.reporting.charts.uncertainty_shares import uncertainty_shares_chart
from certkit.reporting.language import ENGLISH, language
from certkit.reporting.plaintext import aligned
from certkit.reporting.static_page import static_page

if TYPE_CHECKING:
    from certkit.documents.uncertainty_report import CriterionUncertainty, UncertaintyReport
    from certkit.reporting.language import Translate


def uncertainty_page(document: UncertaintyReport, spoken: str = ENGLISH) -> str:
    """Return the page."""
    t = language(spoken).word
    shown = [(each, advice(each, t)) for each in document.criteria]
    chart = uncertainty_shares_chart(document, t)
    return static_page(
        "uncertainty.html.j2", document.title, spoken=spoken, doc=document, criteria=shown, chart=chart
    )


def advice(each: CriterionUncertainty, t: Translate) -> str:
    """Return what to do about a criterion's uncertainty; empty where nothing has to be done."""
    bent = t("bent within the tolerances: U by Monte Carlo, {u}", u=words.significant(each.farthest, 2))
    told = [bent if each.bent else "", _tightened(each, t)]
    return "; ".join(part for part in told if part)


def _tightened(each: CriterionUncertainty, t: Translate) -> str:
    if not each.tighten:
        return ""
    if each.tighten_to is None:
        return t("more than {source} alone has to be tightened", source=each.tighten)
    percent = words.fixed(100 * each.tighten_to, 0)
    return t("tighten {source} to {percent} % of what it is", source=each.tighten, percent=percent)


def uncertainty_text(document: UncertaintyReport) -> str:
    """Return U, its largest source and what to do for a terminal."""
    heads = ("criterion", "value", "U", "MC", "unit", "allowed", "largest source", "share", "")
    rows = [
        (
            each.criterion,
            words.shown(each.value, each.unit),
            words.significant(each.expanded, 2),
            words.significant(each.simulated, 2),
            each.unit,
            words.significant(each.allowed, 2),
            each.lines[0].name if each.lines else "",
            f"{words.fixed(100 * each.lines[0].share, 0)} %" if each.lines else "",
            advice(each, language().word),
        )
        for each in document.criteria
    ]
    risk = words.plain(100 * document.risk, 3)
    failed = f", {document.failed} failed" if document.failed else ""
    return (
        f"{document.title}\n\n{aligned(heads, rows, right=(1, 2, 3, 5, 7))}\n\n"
        f"U: expanded uncertainty, k = 2. MC: the same from {document.runs} runs{failed}. allowed: largest U "
        f"with which the model's value is falsely accepted with {risk} % at most."
    )
