"""Time zero: the first contact, found on the channels where a recording's own trigger is late or early."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.definitions.channels import MOMENT
from certkit.signals.offset import SHORTEST
from certkit.signals.plausibility_steps import noise_of_steps

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.signals.recording import Recording

TOLERANCE = 0.005
"""A trigger up to 5 ms before the contact found on the channels is kept: tape switches are that good, s."""
LATE = 0.002
"""One that comes more than 2 ms behind it is not: nothing is loaded before it is hit, s. An estimate."""

_RISE = 0.05  # of the peak
_FOOT = 0.005  # of the peak, or three times the noise


class Contact(Struct, frozen=True):
    """First contact: `time` on the recording's axis (s) and the `channel` it was found on.

    By the time `risen` (s) that channel is loaded beyond doubt: contact was not later. Where it is `quiet`
    long before, `time` is where it leaves its noise; else it swings, and `time` is a guess.
    """

    time: float
    channel: str
    risen: float
    quiet: bool


def first_contact(recording: Recording, *, flight: float = 0.0) -> Contact | None:
    """Find the first contact.

    The legform names the channels that show it, the quickest first. The channel must rise to 5 % of its
    peak; contact is where that rise leaves the noise (0.5 % of the peak, or three standard deviations of the
    record's first 5 ms).

    Parameters
    ----------
    recording : Recording
    flight : float
        Largest moment that a leg may show in free flight, N·m, either way. Where it swings, what stays within
        is no rise; a channel that stays within throughout shows no contact.

    Returns
    -------
    Contact or None
        None when no channel that shows contact was recorded, when none of them rises, and when one of them
        rises from the first sample on: such a record begins at or after contact, and its own time zero is
        the best there is.
    """
    found: Contact | None = None
    start = slice(0, max(10, int(np.searchsorted(recording.time, recording.time[0] + SHORTEST))))
    for name in recording.table.contact:
        if name not in recording or recording[name].values.size < start.stop:
            continue
        values = recording[name].values
        if not np.isfinite(values).all():
            continue
        if _moves(values, start):
            return None
        if found is not None:
            continue
        edge = _rise(values, start, 2.0 * flight if recording[name].dimension == MOMENT else 0.0)
        if edge is not None:
            # Well before it rises: what comes shortly before may be the blow itself.
            quiet = _quiet(values, 2 * edge[1] // 3)
            at, risen = (float(recording.time[i]) for i in (quiet and _rise(values, start)) or edge)
            found = Contact(at, name, risen, quiet)
    return found


def shifted(recording: Recording, zero: float) -> Recording:
    """Return the recording with its time axis moved so that `zero` (s, old axis) becomes time zero."""
    # To a whole sample, so that zero stays on the axis.
    steps = round((zero - float(recording.time[0])) / recording.interval)
    begin = -steps * recording.interval
    time = begin + recording.interval * np.arange(recording.time.size, dtype=np.float64)
    return replace(recording, time=time)


def _quiet(values: NDArray[np.float64], end: int) -> bool:
    """Tell whether a channel shows hardly more than noise up to a sample; in flight a leg swings."""
    peak = float(np.abs(values - values[0]).max())
    return float(np.ptp(values[: end + 1])) <= 3.0 * _FOOT * peak + 9.0 * noise_of_steps(values) / math.sqrt(
        2.0
    )


def _moves(values: NDArray[np.float64], start: slice) -> bool:
    """Tell whether a channel drifts in the record's start by more than its noise and 0.5 % of its peak."""
    first, second = np.array_split(values[start], 2)
    drift = abs(float(second.mean() - first.mean()))
    noise = max(float(first.std()), float(second.std()))
    return drift > max(_FOOT * float(np.abs(values - first.mean()).max()), 0.5 * noise)


def _rise(values: NDArray[np.float64], start: slice, least: float = 0.0) -> tuple[int, int] | None:
    """Return the indices where the first real rise of a channel begins and where it is one, or None."""
    level = float(values[start].mean())
    noise = float(values[start].std())
    height = np.abs(values - level)
    peak = float(height.max())
    if peak <= max(10 * noise, 1e-12, least):
        return None
    risen = int(np.argmax(height >= max(_RISE * peak, 5 * noise, least)))
    below = np.flatnonzero(height[: risen + 1] <= max(_FOOT * peak, 3 * noise))
    return (int(below[-1]) if below.size else 0), risen
