"""The self-checks of an extraction as tables and figures: groups, leg and faces beside those of the run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.documents.face_outline import outline_at
from certkit.reporting.charts.grid import side_by_side
from certkit.reporting.charts.lines import Line, lines_chart

if TYPE_CHECKING:
    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.self_check import ChannelCheck, SelfCheck
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 220.0
MOMENTS = {"F": "femur moment", "T": "tibia moment"}
INSTANTS = (0.010, 0.020, 0.030, 0.040)
"""s: when faces are drawn side by side."""

STILL = 1e-3
"""m: the movement of a group that moves by less is not drawn."""


@dataclass(frozen=True)
class CheckView:
    """A self-check with its figures; those of the worst group and channel come first."""

    check: SelfCheck
    movement: list[Drawing]
    channels: list[Drawing]
    profile: Drawing | None

    @staticmethod
    def words(name: str) -> str:
        """Return a channel's words."""
        return channel_words(name)


def check_views(result: ExtractionResult) -> list[CheckView]:
    """Return the self-checks as they are shown."""
    return [
        CheckView(
            check,
            _movement(result, check),
            [_channel(check, channel) for channel in check.channels],
            _profiles(result, check) if check.groups else None,
        )
        for check in result.checks
    ]


def channel_words(name: str) -> str:
    """Return a channel's words, so that the gauge F1 is not taken for a face of that name."""
    kind = MOMENTS.get(name[0])
    return f"{kind} {name[1:]}" if kind and name[1:].isdigit() else f"{name} elongation"


def channel_scale(name: str) -> tuple[float, str]:
    """Return the factor from SI to a channel's unit as it is shown, and that unit."""
    return (1e3, "mm") if name.endswith("CL") else (1.0, "N·m")


def channel_times(check: SelfCheck, channel: ChannelCheck) -> list[float]:
    """Return the instants of a channel's values, ms."""
    start = check.start if channel.start is None else channel.start
    step = channel.interval or (check.until - start) / max(len(channel.values) - 1, 1)
    return [1e3 * (start + k * step) for k in range(len(channel.values))]


def _axis(check: SelfCheck, count: int) -> list[float]:
    return [1e3 * (check.start + k * check.interval) for k in range(count)]


def _movement(result: ExtractionResult, check: SelfCheck) -> list[Drawing]:
    groups = {group.name: group for group in result.groups}
    drawn = []
    for found in check.groups:
        if found.run_peak < STILL or not found.displacement:
            continue
        times = _axis(check, len(found.displacement))
        own = groups[found.name].displacement
        run = [
            1e3 * own[min(round((1e-3 * t - result.start) / result.interval), len(own) - 1)] for t in times
        ]
        lines: list[Line] = [
            ("run", times, run),
            ("model", times, [1e3 * x for x in found.displacement]),
        ]
        drawn.append(lines_chart(lines, f"Group {found.name}", "ms", "mm", width=WIDTH, height=HEIGHT))
    return drawn


def _channel(check: SelfCheck, channel: ChannelCheck) -> Drawing:
    scale, unit = channel_scale(channel.name)
    times = channel_times(check, channel)
    lines: list[Line] = [
        ("run", times, [scale * v for v in channel.run_values]),
        ("model", times, [scale * v for v in channel.values]),
    ]
    words = channel_words(channel.name)
    words = words[0].upper() + words[1:]
    return lines_chart(lines, words, "ms", unit, width=WIDTH, height=HEIGHT)


def _profiles(result: ExtractionResult, check: SelfCheck) -> Drawing | None:
    """Draw the faces of the run and of the model at a few instants, height over place."""
    moved = {found.name: found.displacement for found in check.groups}
    faced = [g for g in result.groups if g.outlines and g.name in moved and g.kind == "fascia"]
    if not faced:
        return None
    panels = []
    for instant in INSTANTS:
        if instant > check.until:
            continue
        lines: list[Line] = []
        for name, start, interval in (
            ("run", result.start, result.interval),
            ("model", check.start, check.interval),
        ):
            xs: list[float] = []
            zs: list[float] = []
            for group in sorted(faced, key=lambda g: g.low or 0.0):
                history = group.displacement if name == "run" else moved[group.name]
                for x, z in outline_at(group, history[: 1 + round((instant - start) / interval)]):
                    xs.append(1e3 * z)
                    zs.append(1e3 * x)
            lines.append((name, xs, zs))
        title = f"Faces at {1e3 * instant:.0f} ms"
        panels.append(lines_chart(lines, title, "height, mm", "mm", width=WIDTH, height=HEIGHT))
    return side_by_side(panels, "Faces of run and model")
