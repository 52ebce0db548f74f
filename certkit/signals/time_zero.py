"""Time zero: the first contact, found on the channels where a recording's own trigger is late or early."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from certkit.signals.offset import SHORTEST

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.signals.recording import Recording

TOLERANCE = 0.005
"""A trigger within 5 ms of the contact found on the channels is kept: tape switches are that good, s."""

_RISE = 0.05  # of the peak
_FOOT = 0.005  # of the peak, or three times the noise


class Contact(Struct, frozen=True):
    """First contact: `time` on the recording's axis (s) and the `channel` it was found on."""

    time: float
    channel: str


def first_contact(recording: Recording) -> Contact | None:
    """Find the first contact.

    The legform names the channels that show it, the quickest first. The channel must rise to 5 % of its
    peak; contact is where that rise leaves the noise (0.5 % of the peak, or three standard deviations of the
    record's first 5 ms).

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
        index = _foot(values, start)
        if found is None and index is not None:
            found = Contact(float(recording.time[index]), name)
    return found


def shifted(recording: Recording, zero: float) -> Recording:
    """Return the recording with its time axis moved so that `zero` (s, old axis) becomes time zero."""
    # To a whole sample, so that zero stays on the axis.
    steps = round((zero - float(recording.time[0])) / recording.interval)
    begin = -steps * recording.interval
    time = begin + recording.interval * np.arange(recording.time.size, dtype=np.float64)
    return replace(recording, time=time)


def _moves(values: NDArray[np.float64], start: slice) -> bool:
    """Tell whether a channel drifts in the record's start by more than its noise and 0.5 % of its peak."""
    first, second = np.array_split(values[start], 2)
    drift = abs(float(second.mean() - first.mean()))
    noise = max(float(first.std()), float(second.std()))
    return drift > max(_FOOT * float(np.abs(values - first.mean()).max()), 0.5 * noise)


def _foot(values: NDArray[np.float64], start: slice) -> int | None:
    """Return the index where the first real rise of a channel begins, or None."""
    level = float(values[start].mean())
    noise = float(values[start].std())
    height = np.abs(values - level)
    peak = float(height.max())
    if peak <= max(10 * noise, 1e-12):
        return None
    risen = int(np.argmax(height >= max(_RISE * peak, 5 * noise)))
    below = np.flatnonzero(height[: risen + 1] <= max(_FOOT * peak, 3 * noise))
    return int(below[-1]) if below.size else 0
