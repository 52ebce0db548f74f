"""Channels of the leg over time in the finite-element run and in the lumped model (the paper's Fig. 23)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.reporting.channel_names import channel_scale, channel_words
from certkit.reporting.charts.chosen import chosen
from certkit.reporting.charts.grid import together
from certkit.reporting.charts.lines import Line, lines_chart
from certkit.reporting.coupled_check import check_of
from certkit.reporting.language import Translate, english

if TYPE_CHECKING:
    from collections.abc import Sequence

    from certkit.documents.extraction import ExtractionResult
    from certkit.documents.self_check import ChannelCheck, SelfCheck
    from certkit.reporting.svg import Drawing

WIDTH, HEIGHT = 360.0, 220.0


def draw(result: ExtractionResult, names: Sequence[str]) -> Drawing | None:
    """Draw all channels or those that are named, the worst first; None where there is no coupled run."""
    coupled = check_of(result, "coupled")
    if coupled is None:
        return None
    known = {channel.name: channel for channel in coupled.channels}
    wanted = [known[name] for name in chosen(names, known, "channel")]
    alone = check_of(result, "leg alone")
    panels = [channel_chart(coupled, channel, alone) for channel in wanted]
    return together(panels, f"Channels of the leg in run and model, {result.title}")


def channel_chart(
    check: SelfCheck, channel: ChannelCheck, alone: SelfCheck | None = None, t: Translate = english
) -> Drawing:
    """Draw a channel of run and model with their peaks marked, and what the leg alone makes of it.

    Parameters
    ----------
    check : SelfCheck
        The one that the channel is of.
    channel : ChannelCheck
    alone : SelfCheck, optional
        The leg alone under the run's forces: the part of the difference that is the leg's own.
    t : callable
        Gives the words of a language.
    """
    scale, unit = channel_scale(channel.name)
    lines: list[Line] = [
        (t("run"), channel_times(check, channel), [scale * v for v in channel.run_values]),
        (t("model"), channel_times(check, channel), [scale * v for v in channel.values]),
    ]
    same = next((c for c in alone.channels if c.name == channel.name), None) if alone else None
    if alone and same:
        lines.append((t("leg alone"), channel_times(alone, same), [scale * v for v in same.values]))
    marks = [
        (0, 1e3 * channel.run_time, scale * channel.run_peak),
        (1, 1e3 * channel.time, scale * channel.peak),
    ]
    words = channel_words(channel.name, t)
    title = words[0].upper() + words[1:]
    return lines_chart(lines, title, "ms", unit, width=WIDTH, height=HEIGHT, marks=marks)


def channel_times(check: SelfCheck, channel: ChannelCheck) -> list[float]:
    """Return the instants of a channel's values, ms."""
    start = check.start if channel.start is None else channel.start
    step = channel.interval or (check.until - start) / max(len(channel.values) - 1, 1)
    return [1e3 * (start + k * step) for k in range(len(channel.values))]
