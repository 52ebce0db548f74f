"""The data a page carries for its moving picture and its live curves, small and unable to run."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from certkit.reporting import number_format as words
from certkit.reporting.channel_order import ordered_channels
from certkit.reporting.charts.channel_history import history_frame
from certkit.reporting.charts.motion_frames import FILL, bounds, largest_moment
from certkit.reporting.criterion_row import slug

if TYPE_CHECKING:
    from certkit.documents.result import Result
    from certkit.documents.rig_motion import Motion, Shape

MOST_FRAMES = 120
POSE_UNIT = 1e-4
"""Positions travel as whole tenths of a millimetre, angles as whole tenths of a milliradian."""


def payload(result: Result) -> dict[str, Any]:
    """Gather what the page's scripts need, rounded to what can be seen."""
    return {
        "procedure": result.procedure,
        "interval": [round(t * 1e3, 3) for t in result.interval] if result.interval else None,
        "axis": _axis(result),
        "channels": _channels(result),
        "motion": _motion(result.motion) if result.motion and result.motion.poses else None,
    }


def embedded(data: object) -> str:
    """Write data as JSON that cannot end the script element it stands in."""
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    for sign in "<>&\u2028\u2029":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return text


def differences(numbers: list[int]) -> list[int]:
    """Return the first number and the steps from each to the next, which are shorter to write down.

    100 frames of 40 pieces take 30 KB with their steps' steps, 100 KB as they are.
    """
    return [b - a for a, b in zip([0, *numbers[:-1]], numbers, strict=True)]


def _axis(result: Result) -> dict[str, float] | None:
    if result.curves is None:
        return None
    curves = result.curves
    return {"start": curves.start * 1e3, "step": curves.interval * 1e3, "count": curves.count}


def _channels(result: Result) -> list[dict[str, Any]]:
    curves = result.curves
    if curves is None:
        return []
    axis = curves.milliseconds
    found = []
    for name, criterion in ordered_channels(result).items():
        series = curves.series[name]
        frame, peak, limits = history_frame(series, axis, criterion)
        decimals = words.decimals(series.unit, max((abs(v) for v in series.values), default=1.0))
        band = criterion.band if criterion else None
        found.append(
            {
                "name": name,
                "key": slug(name),
                "title": series.title,
                "label": series.title if name.islower() else name,
                "unit": series.unit,
                "decimals": decimals,
                "steps": differences([round(v * 10 ** (decimals + 1)) for v in series.values]),
                "range": [frame.y.low, frame.y.high],
                "limits": limits,
                "sides": [criterion.lower is not None, criterion.upper is not None] if criterion else [],
                "criterion": criterion.id if criterion else None,
                "peak": list(peak) if peak else None,
                "band": [[[t * 1e3, y] for t, y in line or []] for line in (band.lower, band.upper)]
                if band
                else None,
            }
        )
    return found


def _motion(motion: Motion) -> dict[str, Any]:
    count = len(motion.poses)
    stride = max(1, -(-count // MOST_FRAMES))
    kept = sorted({*range(0, count, stride), count - 1})
    columns = zip(*([v for pose in motion.poses[f] for v in pose] for f in kept), strict=True)
    peak = largest_moment(motion)
    return {
        "unit": POSE_UNIT,
        "times": [round(motion.times[f] * 1e3, 4) for f in kept],
        "box": list(bounds(motion)),
        "shapes": [_shape(shape) for shape in motion.shapes],
        "scene": [_shape(shape) for shape in motion.scene],
        "fill": FILL,
        "joints": motion.joints,
        "moments": [[round(v, 1) for v in motion.moments[f]] for f in kept] if motion.moments else [],
        "peak": peak,
        "poses": [differences(differences([round(v / POSE_UNIT) for v in column])) for column in columns],
    }


def _shape(shape: Shape) -> dict[str, Any]:
    return {
        "name": shape.name,
        "kind": shape.kind,
        "closed": shape.closed,
        "outline": [[round(x, 5), round(z, 5)] for x, z in shape.outline],
    }
