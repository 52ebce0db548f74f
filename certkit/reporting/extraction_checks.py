"""The self-checks of an extraction as tables and figures: groups, leg and faces beside those of the run."""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from typing import TYPE_CHECKING

from certkit.reporting.charts.grid import side_by_side
from certkit.reporting.charts.lines import Line, lines_chart

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import (
        ChannelCheck,
        ExtractionResult,
        GroupResult,
        OutlineResult,
        SelfCheck,
    )
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
    moment = not channel.name.endswith("CL")
    scale, unit = (1.0, "N·m") if moment else (1e3, "mm")
    step = (check.until - check.start) / max(len(channel.values) - 1, 1)
    times = [1e3 * (check.start + k * step) for k in range(len(channel.values))]
    lines: list[Line] = [
        ("run", times, [scale * v for v in channel.run_values]),
        ("model", times, [scale * v for v in channel.values]),
    ]
    words = channel_words(channel.name).capitalize()
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


def outline_at(group: GroupResult, history: Sequence[float]) -> list[tuple[float, float]]:
    """Return a face's points (x, z) in m after a history of its group's displacement, m."""
    largest = max(max(history, default=0.0), 0.0)
    points = _between(group.outlines, largest)
    if group.springing_back and largest > 0:
        last = group.outlines[-1].points
        returning = [*group.springing_back]
        share = history[-1] / largest
        back = _between(returning, share) if share <= returning[-1].at else last
        if share > returning[-1].at:
            weight = (1 - share) / (1 - returning[-1].at) if returning[-1].at < 1 else 0.0
            back = tuple(
                ((1 - weight) * a + weight * c, (1 - weight) * b + weight * d)
                for (a, b), (c, d) in zip(last, returning[-1].points, strict=True)
            )
        scale = largest - group.outlines[-1].at
        points = tuple(
            (x + bx - lx + scale * (share - 1), z + bz - lz)
            for (x, z), (bx, bz), (lx, lz) in zip(points, back, last, strict=True)
        )
    return list(points)


def _between(lines: Sequence[OutlineResult], at: float) -> tuple[tuple[float, float], ...]:
    """Return the outline between two that are known; the last is carried on by the displacement."""
    places = [line.at for line in lines]
    k = bisect_right(places, at)
    if k == 0:
        return lines[0].points
    if k == len(lines):
        return tuple((x + at - places[-1], z) for x, z in lines[-1].points)
    share = (at - places[k - 1]) / (places[k] - places[k - 1])
    return tuple(
        ((1 - share) * a + share * c, (1 - share) * b + share * d)
        for (a, b), (c, d) in zip(lines[k - 1].points, lines[k].points, strict=True)
    )
