"""Channels of a recording as a criterion wants them: filtered with its class, each once."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.filters import FILTERS
from certkit.errors import DataError
from certkit.reasons import Reason, UnusableError, reason_of
from certkit.signals.cfc import through_filter

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from certkit.signals.recording import Channel, Recording


class Filtered:
    """The channels of one recording through their filters, kept so that nothing is filtered twice.

    Parameters
    ----------
    recording : Recording
    wanted : iterable of (str, str)
        Channel and filter pairs that will be asked for; filtered together because that is quicker. Others
        may still be asked for.
    """

    def __init__(self, recording: Recording, wanted: Iterable[tuple[str, str]] = ()) -> None:
        """Filter what is known to be wanted."""
        self.recording = recording
        self._kept: dict[tuple[str, str], NDArray[np.float64]] = {}
        self._windows: dict[tuple[float, float], slice | NDArray[np.bool_]] = {}
        together: dict[str, list[Channel]] = {}
        for name, words in dict.fromkeys(wanted):
            channel = recording.channels.get(name)
            if channel is not None and needs_filter(channel, words) and name in self.finite:
                together.setdefault(words, []).append(channel)
        for words, channels in together.items():
            rows = through_filter(words, np.stack([c.values for c in channels]), recording.interval)
            self._kept |= {(c.name, words): row for c, row in zip(channels, rows, strict=True)}

    @cached_property
    def finite(self) -> frozenset[str]:
        """Return the channels without a value that is not a number."""
        channels = self.recording.channels
        values = [channel.values for channel in channels.values()]
        if len({v.shape for v in values}) == 1:  # all at once, which is several times as quick
            sound = dict(
                zip(channels, np.logical_and.reduce(np.isfinite(np.stack(values)), axis=1), strict=True)
            )
        else:
            sound = {name: np.isfinite(v).all() for name, v in zip(channels, values, strict=True)}
        return frozenset(name for name, whole in sound.items() if whole)

    def within(self, start: float, end: float) -> slice | NDArray[np.bool_]:
        """Return which samples lie between two times, s; both belong to it, up to a rounding of the axis."""
        key = (start, end)
        if key not in self._windows:
            time = self.recording.time
            slack = 1e-9 + 1e-6 * abs(self.recording.interval) if time.size > 1 else 1e-9
            first, last = start - slack, end + slack
            if self._goes_forward:
                begin = int(time.searchsorted(first))
                self._windows[key] = slice(begin, max(begin, int(time.searchsorted(last, side="right"))))
            else:
                self._windows[key] = (time >= first) & (time <= last)
        return self._windows[key]

    @cached_property
    def _goes_forward(self) -> bool:
        time = self.recording.time
        return bool((time[1:] >= time[:-1]).all())

    def values(self, name: str, words: str) -> NDArray[np.float64]:
        """Return the values of a channel through a filter (`none` or `CFC 180`), SI, shape (n,).

        Raises
        ------
        UnusableError
            When the channel is missing, is not finite, or cannot be filtered so, with the reason.
        """
        key = (name, words)
        if key in self._kept:
            return self._kept[key]
        if name not in self.recording:
            raise UnusableError(
                f"channel `{name}` was not recorded", Reason.of("channel-not-recorded", channel=name)
            )
        channel = self.recording[name]
        if channel.values.size == 0:
            raise UnusableError(f"channel `{name}` is empty", Reason.of("channel-empty", channel=name))
        if name not in self.finite:
            bad = int(channel.values.size - np.count_nonzero(np.isfinite(channel.values)))
            raise UnusableError(
                f"channel `{name}`: {bad} of its {channel.values.size} values are not numbers",
                Reason.of("channel-not-finite", channel=name, bad=bad, count=channel.values.size),
            )
        if not needs_filter(channel, words):
            self._kept[key] = channel.values
            return channel.values
        try:
            self._kept[key] = through_filter(words, channel.values, self.recording.interval)
        except DataError as error:
            raise UnusableError(
                f"channel `{name}`: {error}",
                Reason.of("channel-unusable", channel=name, reason=reason_of(error)),
            ) from error
        return self._kept[key]


def needs_filter(channel: Channel, words: str) -> bool:
    """Tell whether a channel still has to go through the filter `words`.

    A channel that has already seen the same class is left as it is; a wider pre-filter (CFC 1000) does not
    count.

    Raises
    ------
    DataError
        When the channel was filtered with a narrower class: what that took away cannot be brought back.
    """
    if words == "none":
        return False
    if words not in FILTERS:
        raise DataError(f"unknown filter `{words}`; write none, {', '.join(FILTERS)}")
    seen, wanted = FILTERS.get(channel.filtered), FILTERS[words]
    if seen is not None and seen.frequency_class < wanted.frequency_class:
        raise UnusableError(
            f"channel `{channel.name}` was already filtered with {channel.filtered}, narrower than {words}; "
            "export it unfiltered",
            Reason.of("channel-filtered-narrower", channel=channel.name, seen=channel.filtered, wanted=words),
        )
    return seen is None or seen.frequency_class != wanted.frequency_class
