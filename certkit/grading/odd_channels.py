"""Oddities that no channel falls for: restlessness before contact, a moment pattern that no leg shows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.reasons import Reason
from certkit.signals.noise import FREE_FLIGHT_NOISE
from certkit.signals.plausibility_motion import off_the_line, surely_on_the_line
from certkit.signals.plausibility_rest import drift_until_peak, is_silent, swing_at_rest

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from certkit.grading.channels_of_leg import LegChannels


def unsteady(leg: LegChannels, doubts: Mapping[str, Reason]) -> Iterator[Reason]:
    """Yield channels of a measured test that are restless before contact; a leg in flight never rests."""
    recording = leg.filtered.recording
    if recording.kind != "measured" or FREE_FLIGHT_NOISE in recording.conditions:
        return
    for name, values in leg.smooth.items():
        if name in doubts or not leg.after[name].size or not leg.blow_beside(name):
            continue
        until_peak = leg.begin + int(np.abs(leg.after[name]).argmax()) - leg.rest // 2
        drift = drift_until_peak(values[: leg.rest], until_peak, leg.peaks[name])
        swing = swing_at_rest(values[: leg.rest], leg.peaks[name])
        if drift is not None:
            yield Reason.of("drifts-at-rest", channel=name, share=100.0 * abs(drift))
        elif swing is not None:
            yield Reason.of("swings-at-rest", channel=name, share=100.0 * swing)


def silent(leg: LegChannels) -> Iterator[Reason]:
    """Yield channels of a measured test without any noise before contact: simulated, or filled in there."""
    if leg.filtered.recording.kind != "measured":
        return
    found = [
        name
        for name, channel in leg.channels.items()
        if is_silent(channel.values[: leg.rest], channel.values, leg.classes[name])
    ]
    if found:
        yield Reason.of("silent-at-rest", channels=found)


def patterns(leg: LegChannels, doubts: Mapping[str, Reason]) -> Iterator[Reason]:
    """Yield gauges that lie off the line between their neighbours by more than a leg can show."""
    for names in leg.bones.values():
        for before, gauge, behind in zip(names, names[1:], names[2:], strict=False):
            three = (before, gauge, behind)
            if any(name in doubts for name in three) or not any(leg.blow_beside(name) for name in three):
                continue
            if surely_on_the_line(leg.products, *three):
                continue  # the quick way out
            share = off_the_line(*(leg.after[name] for name in three))
            if share is not None:
                yield Reason.of("moment-pattern", channel=gauge, others=[before, behind], share=share)
