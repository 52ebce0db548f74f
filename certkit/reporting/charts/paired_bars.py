"""Bars in pairs, run above model: impulse and work of each group, energy that each path took up."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.charts.grid import together
from certkit.reporting.coupled_check import check_of
from certkit.reporting.language import Translate, english
from certkit.reporting.number_format import plain, shortened
from certkit.reporting.scales import Scale, span, ticks
from certkit.reporting.svg import Drawing, label, number, tag

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.self_check import SelfCheck

    Row = tuple[str, float, float]

WIDTH, TOP, ROW, BAR = 360.0, 46.0, 34.0, 11.0
LETTERS = 26
"""Of a name that are shown."""
LEAST = 0.03
"""Share of the largest below which a pair is left out."""


def draw(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw impulse, work and absorbed energy side by side; None where there is no coupled run."""
    del names
    return together(bars_of(result), f"Impulse and energy in run and model, {result.title}")


def bars_of(result: ExtractionResult, t: Translate = english) -> list[Drawing]:
    """Return the charts: what the leg gave each group, from the top down, and what paths took up and bore."""
    check = check_of(result, "coupled")
    if check is None:
        return []
    absorbed = [(p.name, p.run_absorbed, p.absorbed) for p in check.paths]
    absorbed.sort(key=lambda row: -max(abs(row[1]), abs(row[2])))
    peaks = [(p.name, 1e-3 * p.run_peak, 1e-3 * p.peak) for p in check.paths]
    peaks.sort(key=lambda row: -max(abs(row[1]), abs(row[2])))
    drawn = [
        paired_bars(_of_groups(result, check, "impulse"), t("Impulse of the leg on each group"), "N·s", t),
        paired_bars(_of_groups(result, check, "work"), t("Work of the leg on each group"), "J", t),
        paired_bars(absorbed, t("Energy taken up by each path"), "J", t),
        paired_bars(peaks, t("Largest force of each path"), "kN", t),
    ]
    return [each for each in drawn if each]


def _of_groups(result: ExtractionResult, check: SelfCheck, what: str) -> list[Row]:
    height = {group.name: group.low or 0.0 for group in result.groups}
    rows = []
    for group in sorted(check.groups, key=lambda g: -height.get(g.name, 0.0)):
        run, model = getattr(group, f"run_{what}"), getattr(group, what)
        if run is not None and model is not None:
            rows.append((group.name, run, model))
    return rows


def paired_bars(rows: Sequence[Row], title: str, unit: str, t: Translate) -> Drawing | None:
    """Draw a pair of bars for each row (name, run, model); None where there is nothing to draw."""
    largest = max((max(abs(run), abs(model)) for _, run, model in rows), default=0.0)
    shown = [row for row in rows if max(abs(row[1]), abs(row[2])) > LEAST * largest]
    if not shown:
        return None
    left = 16 + 6.6 * min(max(len(name) for name, _, _ in shown), LETTERS)
    low, high = span([0.0, *(v for _, run, model in shown for v in (run, model))], margin=0.0)
    x = Scale(low, high, left + (40 if low < 0 else 0), WIDTH - 52)
    bottom = TOP + ROW * len(shown)
    grid = "".join(f"M{number(x(v))} {number(TOP - 6)}V{number(bottom)}" for v in ticks(low, high, 5) if v)
    drawn = tag("path", d=grid, stroke=palette.GRID, stroke_width=0.8, class_="grid") if grid else ""
    drawn += label(6, 14, title, font_weight="600", class_="title")
    drawn += label(WIDTH - 6, 14, unit, text_anchor="end", fill=palette.MUTED, class_="tick unit")
    for k, words in enumerate((t("run"), t("model"))):
        drawn += _bar(6 + 70 * k, 22, 18, k) + label(29 + 70 * k, 31.5, words, class_="key")
    for row, (name, *pair) in enumerate(shown):
        y = TOP + ROW * row
        drawn += label(
            left - 8,
            y + BAR + 5,
            shortened(name, LETTERS),
            text_anchor="end",
            class_="key",
        )
        for k, value in enumerate(pair):
            start, end = sorted((x(0.0), x(value)))
            drawn += _bar(start, y + k * (BAR + 1), max(end - start, 0.8), k)
            at, anchor = (end + 4, "start") if value >= 0 else (start - 4, "end")
            above = y + k * (BAR + 1) + 9
            drawn += label(at, above, plain(value, 3), text_anchor=anchor, fill=palette.MUTED, class_="tick")
    zero = x(0.0)
    drawn += tag("line", x1=zero, x2=zero, y1=TOP - 6, y2=bottom, stroke=palette.MUTED, class_="zero")
    said = "; ".join(
        f"{name} {t('{first} and {last}', first=plain(run, 3), last=plain(model, 3))}"
        for name, run, model in shown
    )
    return Drawing(WIDTH, bottom + 8, drawn, f"{title}, {t('run')} | {t('model')}, {unit}: {said}")


def _bar(x: float, y: float, width: float, side: int) -> str:
    """Draw a bar: of the run full, of the model with an edge and half seen through."""
    pen = palette.PENS[side]
    return tag(
        "rect",
        x=x,
        y=y,
        width=width,
        height=BAR,
        fill=pen.colour,
        fill_opacity=None if side == 0 else 0.35,
        stroke=pen.colour,
        stroke_width=1.2 if side else 0.0,
        class_=f"bar{side} p{side}",
    )
