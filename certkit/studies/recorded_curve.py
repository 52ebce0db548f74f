"""A curve that a recording has and a simulated test should follow: over time, or one channel over another.

How well it is followed:

- rms: √(mean (y − y₀)²) over the window, in per cent of max |y₀|, y₀ being the recorded curve;
- peak error: largest y over largest y₀ − 1 (smallest over smallest, where the recorded extreme is negative);
- time error: when the one has its peak minus when the other has it;
- ISO/TS 18571 score (`certkit.signals.iso18571`), for curves over time where it is asked for.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct, field

from certkit.definitions.channels import TIME
from certkit.definitions.loading.channel_tables import default_channels
from certkit.errors import DataError, UsageError
from certkit.signals import rate, resampled

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.definitions.channels import ChannelTable, Dimension
    from certkit.signals import Filtered

FINE = 2001
"""Places in the window at which two curves are compared."""


def curve_name(procedure: str, abscissa: str, ordinate: str) -> str:
    """Return what a curve is called: `pendulum/T1 over time`; the abscissa is empty for the time."""
    return f"{procedure}/{ordinate} over {abscissa or 'time'}"


class RecordedCurve(Struct, frozen=True):
    """A recorded curve with the window in which it counts. SI units.

    Parameters
    ----------
    procedure : str
        Whose simulation it is held against.
    abscissa : str
        Short name of a channel; empty for the time.
    ordinate : str
        Short name of a channel.
    words : str
        Filter of the simulated channels: `none`, `CFC 180`.
    x, y : tuple of float
        The recorded curve, already filtered; x rises.
    start, end : float
        Window on the abscissa.
    points : int
        Equally spaced places in the window, at which a fit sees the curve.
    scored : bool
        Whether the ISO/TS 18571 score is wanted.
    table : ChannelTable
        Channels of the legform that was recorded; the shipped one's when missing.
    """

    procedure: str
    abscissa: str
    ordinate: str
    words: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    start: float
    end: float
    points: int = 40
    scored: bool = False
    table: ChannelTable = field(default_factory=default_channels)

    @property
    def name(self) -> str:
        """`pendulum/T1 over time`, `static-knee/MCL over ram force`."""
        return curve_name(self.procedure, self.abscissa, self.ordinate)

    @property
    def dimension(self) -> Dimension:
        """Of the ordinate."""
        return _dimension(self.ordinate, self.table)

    @property
    def across(self) -> Dimension:
        """Of the abscissa."""
        return _dimension(self.abscissa, self.table) if self.abscissa else TIME

    @property
    def places(self) -> NDArray[np.float64]:
        """Where a fit sees the curve, shape (points,)."""
        return np.linspace(self.start, self.end, self.points + 1)[1:]

    def recorded(self, at: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the recorded curve, SI, at abscissas of shape (n,), by straight lines between samples."""
        return np.asarray(np.interp(at, self.x, self.y), dtype=np.float64)

    @property
    def peak(self) -> float:
        """Return the recorded value that is largest in magnitude inside the window."""
        y = self.recorded(np.linspace(self.start, self.end, FINE))
        return float(y[np.argmax(np.abs(y))])

    def at(self, place: float) -> str:
        """Name of the output that is the simulated curve at a place: `pendulum/T1 at 12.5 ms`."""
        return f"{self.name} at {place * self.across.scale:.6g} {self.across.unit}"

    def outputs(self, filtered: Filtered) -> dict[str, float]:
        """Return the simulated curve at all places, and how well it follows the recorded one.

        Raises
        ------
        DataError
            When a channel is missing or the simulation does not cover the window.
        """
        x, y = curve_of(filtered, self.abscissa, self.ordinate, self.words)
        slack = 1e-6 * (self.end - self.start)
        if x[0] > self.start + slack or x[-1] < self.end - slack:
            scale, unit = self.across.scale, self.across.unit
            raise DataError(
                f"{self.name}: simulated from {x[0] * scale:.4g} to {x[-1] * scale:.4g} {unit}, wanted from "
                f"{self.start * scale:.4g} to {self.end * scale:.4g} {unit}; narrow the "
                "target's window, or let the run go on longer"
            )
        scale = self.dimension.scale
        found = {
            self.at(float(place)): float(value) * scale
            for place, value in zip(self.places, np.interp(self.places, x, y), strict=True)
        }
        axis = np.linspace(self.start, self.end, FINE)
        ours, theirs = np.interp(axis, x, y), self.recorded(axis)
        side = np.argmax if self.peak > 0 else np.argmin
        ours_at, theirs_at = int(side(ours)), int(side(theirs))
        rms = float(np.sqrt(np.mean((ours - theirs) ** 2)))
        found[f"{self.name} rms %"] = 100 * rms / abs(self.peak)
        found[f"{self.name} peak"] = float(ours[ours_at]) * scale
        found[f"{self.name} peak error %"] = 100 * float(ours[ours_at] / theirs[theirs_at] - 1)
        if not self.abscissa:
            found[f"{self.name} time error ms"] = 1e3 * float(axis[ours_at] - axis[theirs_at])
        if self.scored:
            pair = [
                resampled(np.asarray(t), np.asarray(v), self.start, self.end)
                for t, v in ((self.x, self.y), (x, y))
            ]
            found[f"{self.name} score"] = rate(pair[0], pair[1]).overall
        return found


def curve_of(
    filtered: Filtered, abscissa: str, ordinate: str, words: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a recording's channel over time, or over another channel where that one first reaches a value.

    Abscissa and ordinate, SI, have the shape (n,).

    Raises
    ------
    DataError
        When a channel is missing or cannot be filtered so.
    """
    y = filtered.values(ordinate, words)
    if not abscissa:
        return filtered.recording.time, y
    x = filtered.values(abscissa, words)
    highest = np.maximum.accumulate(x)
    first = np.concatenate([[True], highest[1:] > highest[:-1]])
    return x[first], y[first]


def _dimension(channel: str, table: ChannelTable) -> Dimension:
    kind = table.find(channel)
    if kind is None:
        raise UsageError(f"no channel is called `{channel}`; `certkit show` lists the legform's")
    return kind.dimension
