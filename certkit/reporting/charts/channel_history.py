"""A channel over time with its corridor and its marked peak."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.definitions.measures import MEASURES
from certkit.reporting import palette
from certkit.reporting.charts.axes import Frame
from certkit.reporting.language import english
from certkit.reporting.number_format import criterion_decimals, fixed, milliseconds, named, verdict_class
from certkit.reporting.scales import span, thinned
from certkit.reporting.svg import Drawing, label, path, tag

if TYPE_CHECKING:
    from certkit.documents.result import CriterionResult, Histories, Series
    from certkit.reporting.language import Translate


def peak_of(criterion: CriterionResult, series: Series, axis: list[float]) -> tuple[float, float] | None:
    """Return where a criterion's value lies on its curve, (ms, value with the curve's sign)."""
    if criterion.value is None or criterion.time is None or not axis:
        return None
    at = criterion.time * 1e3
    nearest = min(range(len(axis)), key=lambda i: abs(axis[i] - at))
    kind = MEASURES.get(criterion.measure)
    turned = kind is not None and kind.magnitude and series.values[nearest] < 0
    return at, -criterion.value if turned else criterion.value


def limits_of(criterion: CriterionResult | None, peak: tuple[float, float] | None) -> list[float]:
    """Return the scalar limits as drawn: mirrored where a largest magnitude was reached below zero."""
    if criterion is None:
        return []
    limits = [v for v in (criterion.lower, criterion.upper) if v is not None]
    turned = peak is not None and criterion.value is not None and peak[1] * criterion.value < 0
    return sorted(-v for v in limits) if turned else limits


def history_frame(
    series: Series, axis: list[float], criterion: CriterionResult | None
) -> tuple[Frame, tuple[float, float] | None, list[float]]:
    """Return the plot's frame, the peak to mark and the limits to draw."""
    peak = peak_of(criterion, series, axis) if criterion else None
    limits = limits_of(criterion, peak)
    band = criterion.band if criterion else None
    edges = [y for line in (band.lower, band.upper) if line for _, y in line] if band else []
    extra = [peak[1]] if peak else []
    y = span([*series.values, *limits, *edges, *extra, 0.0], margin=0.07)
    x = (axis[0], axis[-1]) if len(axis) > 1 else (0.0, 1.0)
    return Frame.around(x, y), peak, limits


def history_chart(
    histories: Histories,
    name: str,
    criterion: CriterionResult | None = None,
    *,
    t: Translate = english,
) -> Drawing:
    """Draw one channel of `histories`; with a criterion also its corridor and peak."""
    series = histories.series[name]
    axis = histories.milliseconds
    frame, peak, limits = history_frame(series, axis, criterion)
    shade = _band(frame, criterion, limits)
    head = _head(criterion, series.unit, t) if peak else series.unit
    drawn = shade + frame.axes(named(name, series.title), "ms", "" if peak else head)
    if peak and criterion:
        css = f"head {verdict_class(criterion.verdict)}"
        drawn += label(frame.right, 14, head, text_anchor="end", font_weight="600", class_=css)
    curve = thinned(list(zip(axis, series.values, strict=False)))
    drawn += tag(
        "path",
        d=path(frame.place(x, y) for x, y in curve),
        fill="none",
        stroke=palette.PENS[0].colour,
        stroke_width=1.6,
        stroke_linejoin="round",
        class_="curve p0",
    )
    if criterion and peak:
        drawn += _peak(frame, criterion, peak)
    words = t("{channel} over time in {unit}", channel=series.title, unit=series.unit)
    if criterion and criterion.value is not None:
        at = criterion.time is not None
        value = f"{fixed(criterion.value, criterion_decimals(criterion))} {criterion.unit}"
        words += f"; {_head(criterion, criterion.unit, t) if at else value}"
    return Drawing(frame.width, frame.height, drawn, words)


def _band(frame: Frame, criterion: CriterionResult | None, limits: list[float]) -> str:
    if criterion is None:
        return ""
    drawn = ""
    if len(limits) == 2:
        drawn += frame.corridor(*limits)
    if limits:
        drawn += "".join(
            tag(
                "line",
                x1=frame.left,
                x2=frame.right,
                y1=frame.y(v),
                y2=frame.y(v),
                stroke=palette.CORRIDOR_EDGE,
                stroke_dasharray="5 3",
                class_="limit",
            )
            for v in limits
        )
    band = criterion.band
    for line in (band.lower, band.upper) if band else ():
        if line:
            drawn += tag(
                "path",
                d=path(frame.place(t * 1e3, y) for t, y in line),
                fill="none",
                stroke=palette.CORRIDOR_EDGE,
                stroke_dasharray="5 3",
                class_="limit",
            )
    return drawn


def _head(criterion: CriterionResult | None, unit: str, t: Translate) -> str:
    if criterion is None:
        return unit
    value = f"{fixed(criterion.value, criterion_decimals(criterion))} {unit}"
    return t("{value} at {time} ms", value=value, time=milliseconds(criterion.time))


def _peak(frame: Frame, criterion: CriterionResult, peak: tuple[float, float]) -> str:
    x, y = frame.place(*peak)
    colour = palette.VERDICT[criterion.verdict]
    css = verdict_class(criterion.verdict)
    return tag(
        "circle", cx=x, cy=y, r=3.6, fill=palette.PAPER, stroke=colour, stroke_width=2, class_=f"peak {css}"
    )
