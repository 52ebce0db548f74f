"""One criterion: what was measured, held against its corridor under a decision rule."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct, field

from certkit.definitions.corridor_set import Band as BandCorridor
from certkit.definitions.corridor_set import Polygon, ValueWindow
from certkit.definitions.loading.channel_tables import default_channels
from certkit.definitions.measures import MEASURES
from certkit.documents.channel_curves import MOST_POINTS, plane_points
from certkit.documents.result import CorridorOverTime, CriterionResult, CurveInPlane, Uncertainty
from certkit.grading.corridor_distance import band_distance, end_faces, polygon_distance, refined
from certkit.grading.corridors import Corridor, Missing, band_lines, find_corridor, limits, polygon_corners
from certkit.grading.decision import SIMPLE_ACCEPTANCE, DecisionRule, decide
from certkit.grading.half_up import half_up
from certkit.reasons import Reason

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

    from numpy.typing import NDArray

    from certkit.definitions.channels import ChannelTable, Dimension
    from certkit.definitions.corridor_set import CorridorSet
    from certkit.definitions.procedure import Criterion
    from certkit.grading.measured_value import MeasuredValue
    from certkit.grading.trace import Trace

START_OF_CURVE = 0.1
"""Share of a curve's largest ordinate below which the margin is not taken: corridors begin narrow."""
COVERED = 0.8
"""Share of a polygon's width or height that a curve has to run through to have been held against it."""


class Judgement(Struct, frozen=True):
    """What criteria are judged with.

    Parameters
    ----------
    corridors : mapping of str to CorridorSet
    rule : DecisionRule
    expanded : mapping of str to float
        Expanded uncertainty U (k = 2) by channel, SI.
    numerical : mapping of str to float
        Numerical uncertainty by criterion id, in the criterion's unit.
    channels : ChannelTable, optional
        Of the legform that was tested; the shipped one's when missing.
    """

    corridors: Mapping[str, CorridorSet]
    rule: DecisionRule = SIMPLE_ACCEPTANCE
    expanded: Mapping[str, float] = field(default_factory=dict)
    numerical: Mapping[str, float] = field(default_factory=dict)
    channels: ChannelTable | None = None


class _Held(Struct, frozen=True):
    """A value with its limits, SI, and the curves that belong to it."""

    value: float | None
    time: float | None
    lower: float | None = None
    upper: float | None = None
    reason: Reason | None = None
    curves: Mapping[str, Any] = field(default_factory=dict)
    judged: float | None = None
    """The value that decides, where a corridor rounds it first."""
    exclusive: bool = False


def grade_criterion(criterion: Criterion, measured: MeasuredValue, judgement: Judgement) -> CriterionResult:
    """Grade one criterion.

    Parameters
    ----------
    criterion : Criterion
    measured : Measured
        From `certkit.grading.measure.measure`.
    judgement : Judgement

    Returns
    -------
    CriterionResult

    Raises
    ------
    UsageError
        When criterion and corridor do not fit together (kinds, channels, units).
    """
    channels = judgement.channels or default_channels()
    found = find_corridor(criterion, judgement.corridors, channels)
    corridor = found if isinstance(found, Corridor) else None
    missing = found if isinstance(found, Missing) else None
    channel = channels.name(criterion.curve.y if criterion.curve is not None else criterion.channel or "")
    common: dict[str, Any] = {
        "id": criterion.id,
        "title": criterion.title,
        "graded": missing is None or missing.required,
        "confidence": None if corridor is None else corridor.confidence,
        "source": "" if corridor is None else corridor.source,
        "corridor": criterion.corridor or "",
        "note": " ".join(n for n in (criterion.note, corridor.entry.note if corridor else None) if n),
        "channel": channel,
        "measure": criterion.measure,
        "filter": criterion.filter,
    }
    dimension = measured.dimension
    if dimension is None or (measured.value is None and measured.trace is None):
        unit = "" if dimension is None else dimension.unit
        return CriterionResult(
            value=None, unit=unit, verdict="not evaluated", coded_reason=measured.reason, **common
        )
    held = _hold(criterion, measured, dimension, corridor, channels)
    scale = dimension.scale
    numerical = judgement.numerical.get(criterion.id)
    expanded = judgement.expanded.get(channel)
    shown: dict[str, Any] = {
        "value": _scaled(held.value, scale),
        "unit": dimension.unit,
        "time": held.time,
        **held.curves,
        **common,
    }
    if missing is not None or held.value is None:
        reason = held.reason or (None if missing is None else missing.reason)
        return CriterionResult(
            verdict="not evaluated",
            coded_reason=measured.doubt or reason,
            uncertainty=_uncertainty(numerical=numerical, expanded=_scaled(expanded, scale)),
            **shown,
        )
    if measured.doubt is not None:
        return CriterionResult(
            verdict="not evaluated",
            coded_reason=measured.doubt,
            lower=_scaled(held.lower, scale),
            upper=_scaled(held.upper, scale),
            **shown,
        )
    decision = decide(
        judgement.rule,
        held.value if held.judged is None else held.judged,
        held.lower,
        held.upper,
        expanded,
        exclusive=held.exclusive,
    )
    verdict, reason = decision.verdict, decision.reason
    margin = _scaled(decision.margin, scale)
    if verdict == "pass" and numerical is not None and margin is not None and margin < numerical:
        verdict = "conditional"
        reason = Reason.of("within-numerical-uncertainty", uncertainty=numerical, unit=dimension.unit)
    return CriterionResult(
        verdict=verdict,
        coded_reason=reason,
        lower=_scaled(held.lower, scale),
        upper=_scaled(held.upper, scale),
        margin=margin,
        uncertainty=_uncertainty(
            numerical=numerical,
            expanded=_scaled(expanded, scale),
            guard_band=_scaled(decision.guard_band, scale),
            false_accept=decision.false_accept,
        ),
        **shown,
    )


def _uncertainty(**parts: float | None) -> Uncertainty | None:
    """Return what is known of a value's uncertainty, in its unit; None where nothing is."""
    known = {name: part for name, part in parts.items() if part is not None}
    return Uncertainty(**known) if known else None


def _scaled(value: float | None, scale: float) -> float | None:
    return None if value is None else value * scale


def _hold(
    criterion: Criterion,
    measured: MeasuredValue,
    dimension: Dimension,
    corridor: Corridor | None,
    channels: ChannelTable,
) -> _Held:
    """Bring value and limits together; a whole curve's value is its distance to the border, the limit 0."""
    entry = None if corridor is None else corridor.entry
    trace = measured.trace
    if trace is None:
        if corridor is None or not isinstance(entry, ValueWindow):
            return _Held(measured.value, measured.time)
        lower, upper = limits(corridor, entry, dimension)
        judged = _judged(measured.value, entry.decimals, dimension, (lower, upper))
        return _Held(measured.value, measured.time, lower, upper, judged=judged, exclusive=entry.exclusive)
    if corridor is None or isinstance(entry, ValueWindow) or entry is None:
        return _shown_only(trace, drawn=MEASURES[criterion.measure].corridor is Polygon)
    if isinstance(entry, Polygon):
        return _inside_polygon(trace, polygon_corners(corridor, entry, criterion, trace, channels))
    return _inside_band(trace, corridor, entry)


def _judged(
    value: float | None, decimals: int | None, dimension: Dimension, limits: tuple[float | None, ...]
) -> float | None:
    """Round a value half up in the unit of reports; a limit that it comes to is met to the last bit."""
    if value is None or decimals is None:
        return value
    shown = half_up(value * dimension.scale, decimals)
    same = [a for a in limits if a is not None and half_up(a * dimension.scale, decimals) == shown]
    return same[0] if same else shown / dimension.scale


def _shown_only(trace: Trace, *, drawn: bool) -> _Held:
    """Give the largest ordinate of a curve that nothing is held against."""
    index = int(np.argmax(np.abs(trace.y)))
    curves = {"curve": _plane(trace, None)} if drawn else {}
    return _Held(float(trace.y[index]), float(trace.time[index]), curves=curves)


def _inside_polygon(trace: Trace, corners: NDArray[np.float64]) -> _Held:
    """Hold a curve against a polygon."""
    curves = {"curve": _plane(trace, corners)}
    size = np.ptp(corners, axis=0)
    low = corners.min(axis=0)
    if trace.y.size < 2:
        return _Held(None, None, reason=Reason.of("single-point"), curves=curves)
    x, y, index = refined(trace.x, trace.y)
    covered = max(
        (min(float(v.max()), float(begin + extent)) - max(float(v.min()), float(begin))) / float(extent)
        for v, begin, extent in zip((x, y), low, size, strict=True)
    )
    distance = polygon_distance(x, y, corners, end_faces(x, y, corners))
    counted = np.abs(y) >= START_OF_CURVE * np.abs(y).max()
    if (distance < 0).any():
        counted = np.ones_like(counted)
    elif covered < COVERED:
        reason = Reason.of("curve-covers-little", covered=max(0.0, covered), needed=COVERED)
        return _Held(None, None, reason=reason, curves=curves)
    at = int(np.flatnonzero(counted)[np.argmin(distance[counted])])
    time = float(np.interp(index[at], np.arange(trace.time.size), trace.time))
    return _Held(float(distance[at]), time, lower=0.0, curves=curves)


def _inside_band(trace: Trace, corridor: Corridor, band: BandCorridor) -> _Held:
    """Hold a channel against a corridor over time."""
    lower, upper = band_lines(corridor, band, trace.y_dimension)
    curves = {
        "band": CorridorOverTime(
            **{side: _points(line, trace.y_dimension) for side, line in _sides(lower, upper)}
        )
    }
    reach = [(line[0, 0], line[-1, 0]) for _, line in _sides(lower, upper)]
    begin, end = min(r[0] for r in reach), max(r[1] for r in reach)
    step = float(trace.time[-1] - trace.time[0]) / max(1, trace.time.size - 1)
    if trace.time[0] > begin + step or trace.time[-1] < end - step:
        reason = Reason.of(
            "recorded-too-short",
            start=float(trace.time[0]) * 1e3,
            end=float(trace.time[-1]) * 1e3,
            corridor_start=float(begin) * 1e3,
            corridor_end=float(end) * 1e3,
        )
        return _Held(None, None, reason=reason, curves=curves)
    distance = band_distance(trace.time, trace.y, lower, upper)
    at = int(np.argmin(distance))
    if not np.isfinite(distance[at]):
        return _Held(None, None, reason=Reason.of("no-sample-under-corridor"), curves=curves)
    return _Held(float(distance[at]), float(trace.time[at]), lower=0.0, curves=curves)


def _sides(
    lower: NDArray[np.float64] | None, upper: NDArray[np.float64] | None
) -> list[tuple[str, NDArray[np.float64]]]:
    return [(side, line) for side, line in (("lower", lower), ("upper", upper)) if line is not None]


def _points(line: NDArray[np.float64], dimension: Dimension) -> list[tuple[float, float]]:
    return [(float(t), float(v) * dimension.scale) for t, v in line]


def _plane(trace: Trace, corners: NDArray[np.float64] | None) -> CurveInPlane:
    """Return the curve, and its polygon, in the units at the borders."""
    x, y = trace.x_dimension, trace.y_dimension
    polygon = None if corners is None else [(float(a) * x.scale, float(b) * y.scale) for a, b in corners]
    return CurveInPlane(
        x_title=trace.x_title,
        x_unit=x.unit,
        y_title=trace.y_title,
        y_unit=y.unit,
        points=plane_points(trace.x * x.scale, trace.y * y.scale, MOST_POINTS),
        polygon=polygon,
    )
