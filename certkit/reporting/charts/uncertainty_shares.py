"""The chart of an uncertainty budget: for each criterion, what its variance comes from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.number_format import significant
from certkit.reporting.svg import Drawing, label, tag

if TYPE_CHECKING:
    from certkit.documents.uncertainty_report import UncertaintyReport
    from certkit.reporting.language import Translate

WIDTH = 820.0
_ROW, _TOP, _LEFT, _RIGHT = 26.0, 12.0, 70.0, 130.0
_SHADES = ("#0b5cad", "#c04e00", "#00795a", "#9a3d7f", "#946200", "#3a3f45", "#2f7fb5", "#7b2d8b")
_LEGEND_WIDTH = 270.0
_LEAST_LABEL = 0.06
"""Share of the bar from which its percentage is written into it."""


def uncertainty_shares_chart(document: UncertaintyReport, t: Translate) -> Drawing:
    """Draw one bar of 100 % a criterion, cut by source in one order; U stands at its end."""
    names = list(dict.fromkeys(line.name for each in document.criteria for line in each.lines))
    length = WIDTH - _LEFT - _RIGHT
    drawn = ""
    for row, each in enumerate(document.criteria):
        top = _TOP + row * _ROW
        drawn += label(_LEFT - 8, top + 13, each.criterion, text_anchor="end", font_weight="600")
        shares = {line.name: line.share for line in each.lines}
        place = _LEFT
        for number, name in enumerate(names):
            width = length * shares.get(name, 0.0)
            if width > 0:
                drawn += tag("rect", x=place, y=top, width=width, height=18, fill=_SHADES[number % 8])
                if shares[name] >= _LEAST_LABEL:
                    drawn += label(
                        place + width / 2,
                        top + 13,
                        f"{100 * shares[name]:.0f} %",
                        text_anchor="middle",
                        fill=palette.PAPER,
                    )
            place += width
        drawn += label(_LEFT + length + 10, top + 13, f"U = {significant(each.expanded, 2)} {each.unit}")
    below = _TOP + len(document.criteria) * _ROW + 10
    columns = max(1, int(WIDTH // _LEGEND_WIDTH))
    for number, name in enumerate(names):
        x = 10 + (number % columns) * _LEGEND_WIDTH
        y = below + (number // columns) * 18
        drawn += tag("rect", x=x, y=y, width=11, height=11, fill=_SHADES[number % 8])
        drawn += label(x + 17, y + 10, name, fill=palette.MUTED, class_="tick")
    height = below + 18 * ((len(names) + columns - 1) // columns) + 6
    said = t("Shares of {count} sources in the variance of each criterion", count=len(names))
    return Drawing(WIDTH, height, drawn, said)
