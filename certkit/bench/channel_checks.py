"""The leg's channels of a model beside those of its run: peaks, their times, and the curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.documents.self_check import ChannelCheck
from certkit.signals.cfc import cfc

if TYPE_CHECKING:
    from certkit.exchange.fe import FrontData
    from certkit.mechanics import Simulation

FREQUENCY_CLASS = 180.0
"""CFC of peaks and curves."""

POINTS = 200
"""Of a series that is kept."""


def channel_checks(
    data: FrontData, done: Simulation, *, start: float, until: float
) -> tuple[ChannelCheck, ...]:
    """Compare the leg's channels, filtered, from first contact to the checks' end; the worst first.

    Parameters
    ----------
    data : FrontData
        The run's histories.
    done : Simulation
        Of the model, time zero at first contact.
    start, until : float
        First contact and the checks' end on the run's time axis, s.
    """
    interval = done.recording.interval
    time = done.recording.time
    time = time[time + start <= until]
    every = max(1, time.size // POINTS)
    checks = []
    for name, values in data.histories.leg.items():
        if name not in done.recording.channels:
            continue
        wanted = cfc(np.interp(time + start, data.histories.time, values), interval, FREQUENCY_CLASS)
        got = cfc(done.recording[name].values, interval, FREQUENCY_CLASS)[: time.size]
        i, j = int(np.argmax(got)), int(np.argmax(wanted))
        largest = float(wanted[j])
        if largest <= 0:
            continue
        checks.append(
            ChannelCheck(
                name=name,
                peak=float(got[i]),
                run_peak=largest,
                time=float(time[i] + start),
                run_time=float(time[j] + start),
                error_percent=percent_above(float(got[i]), largest),
                rms_percent=100 * float(np.sqrt(np.mean((got - wanted) ** 2))) / largest,
                values=tuple(map(float, got[::every])),
                run_values=tuple(map(float, wanted[::every])),
                start=start,
                interval=interval * every,
            )
        )
    return tuple(sorted(checks, key=lambda c: -c.rms_percent))


def percent_above(value: float, reference: float) -> float:
    """Return by how much a value is above its reference, %; 0 where the reference is zero."""
    return 100.0 * (value / reference - 1.0) if reference != 0 else 0.0
