"""Free flight: tibia moments stay within ±15 N·m during the last 30 ms before contact.

UN R127, 02 series, annex 5, 1.13. The clause names the tibia only; which channels that are says the legform.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

if TYPE_CHECKING:
    from certkit.signals.recording import Recording

WINDOW = 0.030
"""Seconds before contact."""
ALLOWED = 15.0
"""Largest moment of a tibia in free flight, either way, N·m."""
FREE_FLIGHT_NOISE = "free-flight noise"
"""Name of the condition, N·m."""


class FreeFlightNoise(Struct, frozen=True):
    """The largest tibia moment in free flight.

    Parameters
    ----------
    largest : float
        Largest absolute moment, N·m.
    channel : str
        Where it was.
    """

    largest: float
    channel: str


def free_flight(recording: Recording) -> FreeFlightNoise | None:
    """Return the largest tibia moment during the last 30 ms before time zero.

    Returns
    -------
    FreeFlightNoise or None
        None when less than the whole window was recorded, or no tibia moment that is finite there. A
        finite-element run begins shortly before contact; all that it has of the window counts.
    """
    time = recording.time
    if time.size < 2 or time[0] >= 0:
        return None
    if recording.kind != "virtual" and time[0] > -WINDOW + 1.5 * recording.interval:
        return None
    window = slice(int(np.searchsorted(time, -WINDOW)), int(np.searchsorted(time, 0.0)))
    largest = {
        name: float(np.abs(recording[name].values[window]).max())
        for name in recording.table.flight
        if name in recording
    }
    if not largest or not all(np.isfinite(v) for v in largest.values()):
        return None
    channel = max(largest, key=lambda name: largest[name])
    return FreeFlightNoise(largest[channel], channel)
