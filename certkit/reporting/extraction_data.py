"""The data that an extraction's page holds for its moving picture: lines of run and model, and the gauges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from certkit.reporting.channel_names import channel_scale, channel_words
from certkit.reporting.charts.motion_frames import FILL
from certkit.reporting.charts.run_and_model import moment_peak, view_box
from certkit.reporting.coupled_check import check_of
from certkit.reporting.number_format import decimals as decimals_of
from certkit.reporting.page_data import differences
from certkit.reporting.scales import span

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.front_motion import FrontMotion, MovingLine
    from certkit.documents.self_check import ChannelCheck

PLACE_UNIT = 1e-4
"""Places travel as whole tenths of a millimetre."""


def extraction_payload(result: ExtractionResult, worst: str | None) -> dict[str, Any] | None:
    """Return what the page's scripts need; None where nothing was recorded in motion.

    Parameters
    ----------
    result : ExtractionResult
    worst : str or None
        The group that is marked.
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
        "channels": [_channel(check) for check in timed],
        "motion": _motion(result.motion, worst),
    }


def _down_the_leg(check: ChannelCheck) -> tuple[int, str]:
    """Return where a channel stands: femur from above, tibia, then ligaments."""
    part, number = check.name[:1], check.name[1:]
    if not number.isdigit():
        return 2, check.name
    return (0, f"{9999 - int(number):04d}") if part == "F" else (1, number.zfill(4))


def _channel(check: ChannelCheck) -> dict[str, Any]:
    scale, unit = channel_scale(check.name)
    values, run = ([scale * v for v in series] for series in (check.values, check.run_values))
    places = decimals_of(unit, max(map(abs, (*values, *run)), default=1.0))
    low, high = span([0.0, *values, *run])
    return {
        "name": channel_words(check.name),
        "title": f"{channel_words(check.name)}, CFC 180",
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


def _motion(motion: FrontMotion, worst: str | None) -> dict[str, Any]:
    return {
        "unit": PLACE_UNIT,
        "times": [round(t * 1e3, 4) for t in motion.times],
        "box": [round(v, 4) for v in view_box(motion)],
        "shapes": [],
        "scene": [],
        "fill": FILL,
        "joints": [],
        "moments": [],
        "peak": moment_peak(motion),
        "poses": [],
        "lines": [_line(line, worst) for line in motion.lines],
    }


def _line(line: MovingLine, worst: str | None) -> dict[str, Any]:
    found: dict[str, Any] = {"name": line.name, "kind": line.kind, "closed": line.closed}
    if line.kind != "leg":
        found["words"] = line.name
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
    return found
