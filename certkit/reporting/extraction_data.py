"""The data that an extraction's page holds for its moving picture: lines of run and model, and the gauges."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from typing import TYPE_CHECKING, Any

from certkit.reporting.channel_names import channel_scale, channel_words
from certkit.reporting.charts.group_response import contact_path
from certkit.reporting.charts.motion_frames import FILL
from certkit.reporting.charts.run_and_model import moment_peak, view_box
from certkit.reporting.coupled_check import check_of, check_times, group_of
from certkit.reporting.number_format import decimals as decimals_of
from certkit.reporting.number_format import shortened
from certkit.reporting.page_data import differences
from certkit.reporting.scales import span, ticks

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.front_motion import FrontMotion, MovingLine
    from certkit.documents.self_check import ChannelCheck
    from certkit.reporting.language import Translate

PLACE_UNIT = 1e-4
"""Places travel as whole tenths of a millimetre."""
LETTERS = 14
"""Of a group's name that stand beside it in motion."""
BARS, INSET = 0.12, 0.008
"""m on the left of what moves, in which bars show the leg's force on each group, and their distance to it."""


def extraction_payload(result: ExtractionResult, worst: str | None, t: Translate) -> dict[str, Any] | None:
    """Return what the page's scripts need; None where nothing was recorded in motion.

    Parameters
    ----------
    result : ExtractionResult
    worst : str or None
        The group that is marked.
    t : callable
        Gives the words of a language.
    """
    if result.motion is None:
        return None
    coupled = check_of(result, "coupled")
    channels = sorted(coupled.channels, key=_down_the_leg) if coupled else []
    timed = [c for c in channels if c.start is not None and c.interval is not None]
    axis = None
    if timed:
        start, step = timed[0].start or 0.0, timed[0].interval or 0.0
        axis = {"start": round(start * 1e3, 4), "step": round(step * 1e3, 6), "count": len(timed[0].values)}
    return {
        "procedure": result.case,
        "interval": None,
        "axis": axis,
        "channels": [_channel(check, t) for check in timed],
        "motion": _motion(result, result.motion, worst),
    }


def _down_the_leg(check: ChannelCheck) -> tuple[int, str]:
    """Return where a channel stands: femur from above, tibia, then ligaments."""
    part, number = check.name[:1], check.name[1:]
    if not number.isdigit():
        return 2, check.name
    return (0, f"{9999 - int(number):04d}") if part == "F" else (1, number.zfill(4))


def _channel(check: ChannelCheck, t: Translate) -> dict[str, Any]:
    scale, unit = channel_scale(check.name)
    values, run = ([scale * v for v in series] for series in (check.values, check.run_values))
    places = decimals_of(unit, max(map(abs, (*values, *run)), default=1.0))
    low, high = span([0.0, *values, *run])
    return {
        "name": channel_words(check.name, t),
        "title": f"{channel_words(check.name, t)}, CFC 180",
        "unit": unit,
        "decimals": places,
        "steps": _steps(run, places),
        "model": _steps(values, places),
        "range": [round(low, 3), round(high, 3)],
        "limits": [],
        "peak": None,
        "band": None,
    }


def _steps(values: Sequence[float], places: int) -> list[int]:
    return differences([round(v * 10 ** (places + 1)) for v in values])


def _motion(result: ExtractionResult, motion: FrontMotion, worst: str | None) -> dict[str, Any]:
    pressed = {line.name: _contact(result, motion, line.name) for line in motion.lines if line.kind == "face"}
    largest = max((v for sides in pressed.values() for row in sides.values() for v in row), default=0.0)
    left, right, low, high = view_box(motion)
    return {
        "unit": PLACE_UNIT,
        "times": [round(t * 1e3, 4) for t in motion.times],
        "box": [round(left - (BARS if largest else 0.0), 4), round(right, 4), round(low, 4), round(high, 4)],
        "bars": _bars(left - BARS + INSET, largest) if largest else None,
        "shapes": [],
        "scene": [],
        "fill": FILL,
        "joints": [],
        "moments": [],
        "peak": moment_peak(motion),
        "poses": [],
        "lines": [_line(line, worst, pressed.get(line.name, {})) for line in motion.lines],
    }


def _bars(left: float, largest: float) -> list[float]:
    """Return where bars of force begin (m), how long they are (m/N), and a round force to measure them by."""
    scale = (BARS - 3 * INSET) / largest
    rounds = ticks(0.0, largest, 3)
    return [round(left, 4), float(f"{scale:.6g}"), rounds[1] if len(rounds) > 1 else largest]


def _contact(result: ExtractionResult, motion: FrontMotion, name: str) -> dict[str, list[float]]:
    """Return the leg's force on a group at each frame, its mean over a frame, N, in run and model."""
    path, own = contact_path(result, name), group_of(check_of(result, "coupled"), name)
    check = check_of(result, "coupled")
    if path is None or own is None or check is None or not own.force:
        return {}
    return {
        "run": _means(result.times, path.force, motion.times),
        "model": _means([1e-3 * t for t in check_times(check, len(own.force))], own.force, motion.times),
    }


def _means(times: Sequence[float], values: Sequence[float], frames: Sequence[float]) -> list[float]:
    """Return the means of a history around each frame, as long as the frames are apart."""
    half = 0.5 * (frames[-1] - frames[0]) / max(len(frames) - 1, 1) + 1e-9
    means = []
    for frame in frames:
        low, high = bisect_left(times, frame - half), bisect_right(times, frame + half)
        part = values[low:high]
        means.append(max(sum(part) / len(part), 0.0) if part else 0.0)
    return means


def _line(line: MovingLine, worst: str | None, pressed: dict[str, list[float]]) -> dict[str, Any]:
    found: dict[str, Any] = {"name": line.name, "kind": line.kind, "closed": line.closed}
    if line.kind != "leg":
        found["words"] = shortened(line.name, LETTERS)
    first = (line.run or line.model)[0] if line.run or line.model else ()
    if pressed and first:
        found["middle"] = round(0.5 * (first[0][1] + first[-1][1]), 4)
    if line.name == worst:
        found["marked"] = True
    for side, frames, moments in (
        ("run", line.run, line.run_moments),
        ("model", line.model, line.model_moments),
    ):
        if frames:
            columns = zip(*([v for point in frame for v in point] for frame in frames), strict=True)
            places = [differences(differences([round(v / PLACE_UNIT) for v in c])) for c in columns]
            found[side] = {"places": places} | (
                {"moments": [[round(v) for v in row] for row in moments]} if moments else {}
            )
            if side in pressed:
                found[side]["forces"] = [round(v) for v in pressed[side]]
    return found
