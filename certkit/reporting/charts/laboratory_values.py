"""The chart of a round robin: each laboratory's values and mean, with s_R around the mean of all."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting import palette
from certkit.reporting.number_format import named, plain, shortened, shown
from certkit.reporting.scales import Scale, span, ticks
from certkit.reporting.svg import Drawing, label, path, tag
from certkit.reporting.translated_titles import title_in

if TYPE_CHECKING:
    from certkit.documents.round_robin_report import CriterionPrecision, LaboratoryRow
    from certkit.reporting.language import Language

WIDTH = 400.0
HEIGHT = 210.0
_MEAN_HALF_WIDTH = 9.0


def laboratory_values_chart(criterion: CriterionPrecision, spoken: Language) -> Drawing:
    """Draw the values of all laboratories in one criterion, with the limits of its corridor as dashed lines.

    The band is the mean ± 2 s_R: one laboratory's value in twenty lies outside it.
    """
    reach = 2 * (criterion.reproducibility or 0.0)
    values = [value for row in criterion.rows for value in row.values]
    low, high = span([*values, criterion.mean - reach, criterion.mean + reach])
    y = Scale(low, high, HEIGHT - 34, 26)
    left, right = 48.0, WIDTH - 8
    step = (right - left) / len(criterion.rows)
    band = y(criterion.mean + reach)
    drawn = tag(
        "rect",
        x=left,
        y=band,
        width=right - left,
        height=y(criterion.mean - reach) - band,
        fill=palette.CORRIDOR,
        class_="corridor",
    )
    for value in ticks(low, high, 5):
        drawn += tag("line", x1=left, x2=right, y1=y(value), y2=y(value), stroke=palette.GRID, class_="grid")
        drawn += label(
            left - 6, y(value) + 3.6, plain(value), text_anchor="end", fill=palette.MUTED, class_="tick"
        )
    drawn += _level(y(criterion.mean), left, right, None)
    for limit in (criterion.lower, criterion.upper):
        if limit is not None and low < limit < high:
            drawn += _level(y(limit), left, right, "4 3")
    for number, row in enumerate(criterion.rows):
        drawn += _laboratory(row, left + step * (number + 0.5), step, y)
    title = f"{criterion.procedure}: {named(criterion.criterion, title_in(criterion.title, spoken))}"
    drawn += label(6, 14, title, font_weight="600", class_="title")
    drawn += label(right, 14, criterion.unit, text_anchor="end", fill=palette.MUTED, class_="tick unit")
    said = spoken.word(
        "{count} values of {laboratories} laboratories, mean {mean} {unit}",
        count=criterion.tests,
        laboratories=len(criterion.rows),
        mean=shown(criterion.mean, criterion.unit),
        unit=criterion.unit,
    )
    return Drawing(WIDTH, HEIGHT, drawn, f"{title}: {said}")


def _level(place: float, left: float, right: float, dash: str | None) -> str:
    return tag(
        "line",
        x1=left,
        x2=right,
        y1=place,
        y2=place,
        stroke=palette.MUTED,
        stroke_dasharray=dash,
        class_="zero",
    )


def _laboratory(row: LaboratoryRow, place: float, step: float, y: Scale) -> str:
    marked = "outlier" in {row.cochran, row.grubbs}
    colour = palette.VERDICT["fail"] if marked else palette.PENS[0].colour
    css_class = "outside" if marked else "dot p0"
    drawn = "".join(
        tag("circle", cx=place, cy=y(value), r=3.2, fill=colour, class_=css_class) for value in row.values
    )
    ends = [(place - _MEAN_HALF_WIDTH, y(row.mean)), (place + _MEAN_HALF_WIDTH, y(row.mean))]
    drawn += tag("path", d=path(ends), stroke=palette.INK, stroke_width=1.6, fill="none", class_="curve mean")
    most = max(3, int(step / 6))
    name = shortened(row.laboratory, most)
    return drawn + label(place, HEIGHT - 14, name, text_anchor="middle", fill=palette.MUTED, class_="tick")
