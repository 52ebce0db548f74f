"""The leg's channels of a model beside those of its run: peaks, their times, and the curves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.documents.self_check import ChannelCheck
from certkit.signals.cfc import cfc

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from certkit.exchange.fe import FrontData
    from certkit.mechanics import Simulation

    Values = NDArray[np.float64]

FREQUENCY_CLASS = 180.0
"""CFC of peaks and curves."""

POINTS = 200
"""Of a series that is kept."""

NO_PEAK = 0.01
"""Share of a channel's largest value, of either sign, below which what it shows above zero is no peak."""

OPPOSITE = 0.5
"""Cosine between two curves from which on they go opposite ways."""

CONFUSED = 10.0
"""By how much two curves differ when their units are not the same."""


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
    checks = []
    for name, time, got, wanted in _curves(data, done, start, until):
        every = max(1, time.size // POINTS)
        i, j = int(np.argmax(got)), int(np.argmax(wanted))
        largest = float(wanted[j])
        if largest <= NO_PEAK * float(np.abs(wanted).max()):
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


def channel_remarks(data: FrontData, done: Simulation, *, start: float, until: float) -> list[str]:
    """Return what tells that channels of the run have another sign or unit than the leg's own.

    Parameters
    ----------
    data : FrontData
        The run's histories.
    done : Simulation
        Of the leg under the run's own contact forces, time zero at first contact.
    start, until : float
        First contact and the checks' end on the run's time axis, s.
    """
    turned, scaled = [], []
    for name, _, got, wanted in _curves(data, done, start, until):
        own, largest = float(np.abs(got).max()), float(np.abs(wanted).max())
        if min(own, largest) <= 0:
            continue
        if float(np.dot(got, wanted)) < -OPPOSITE * float(np.linalg.norm(got) * np.linalg.norm(wanted)):
            turned.append(name)
        elif not 1 / CONFUSED < largest / own < CONFUSED:
            scaled.append(f"{name} ({largest / own:.3g} times the leg's)")
    said = []
    if turned:
        said.append(
            f"under the run's own contact forces the leg's {', '.join(turned)} goes the other way than in "
            "the run: turn the sign of its column (positive is tension on the far side, and a ligament that "
            "grows longer)"
        )
    if scaled:
        said.append(
            f"under the run's own contact forces the leg is far from the run's {', '.join(scaled)}: is the "
            "column in the unit of its name?"
        )
    return said


def _curves(
    data: FrontData, done: Simulation, start: float, until: float
) -> Iterator[tuple[str, Values, Values, Values]]:
    """Yield the channels that both have: name, time from first contact, filtered values of model and run."""
    interval = done.recording.interval
    time = done.recording.time
    time = time[time + start <= until]
    for name, values in data.histories.leg.items():
        if name in done.recording.channels:
            wanted = cfc(np.interp(time + start, data.histories.time, values), interval, FREQUENCY_CLASS)
            got = cfc(done.recording[name].values, interval, FREQUENCY_CLASS)[: time.size]
            yield name, time, got, wanted


def percent_above(value: float, reference: float) -> float:
    """Return by how much a value is above its reference, %; 0 where the reference is zero."""
    return 100.0 * (value / reference - 1.0) if reference != 0 else 0.0
