"""The channels of a leg as the plausibility gate compares them: each beside its neighbours on one leg."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.definitions.channels import ELONGATION, MOMENT
from certkit.errors import DataError
from certkit.signals.condition import SETTLED
from certkit.signals.offset import MARGIN
from certkit.signals.plausibility_motion import blow

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.grading.trace import EvaluationWindow
    from certkit.signals import Channel, Filtered

FILTER = "CFC 180"
"""Filter of the channels that are compared with their neighbours, that of all criteria."""


class LegChannels(Struct, frozen=True, dict=True):
    """Bone moments and elongations of a recording, with their classes, filtered, from contact on.

    Parameters
    ----------
    filtered : Filtered
        The conditioned recording.
    window : EvaluationWindow
        Seconds that are evaluated.
    decided : float
        Seconds at which the last criterion is decided.
    """

    filtered: Filtered
    window: EvaluationWindow
    decided: float

    @cached_property
    def channels(self) -> dict[str, Channel]:
        """Return channels that have an amplitude class and are finite."""
        kinds = self.filtered.recording.table.kinds
        return {
            name: channel
            for name, channel in self.filtered.recording.channels.items()
            if name in kinds
            and kinds[name].amplitude_class is not None
            and channel.dimension in {MOMENT, ELONGATION}
            and channel.values.size > 1
            and np.isfinite(channel.values).all()
        }

    @cached_property
    def begin(self) -> int:
        """Return the index of contact."""
        return int(np.searchsorted(self.filtered.recording.time, 0.0))

    @cached_property
    def rest(self) -> int:
        """Return the index behind the last sample at rest."""
        return int(np.searchsorted(self.filtered.recording.time, -MARGIN))

    @cached_property
    def end(self) -> int:
        """Return the index behind the last sample that decides, the filters' reach included."""
        return int(np.searchsorted(self.filtered.recording.time, self.decided + SETTLED, side="right"))

    @cached_property
    def smooth(self) -> dict[str, NDArray[np.float64]]:
        """Return the channels through the filter, SI, shape (n,) each; as recorded where that cannot be."""
        found = {}
        for name, channel in self.channels.items():
            try:
                found[name] = self.filtered.values(name, FILTER)
            except DataError:
                found[name] = channel.values
        return found

    @cached_property
    def recorded_rows(self) -> NDArray[np.float64]:
        """Return the channels as recorded, SI, shape (channels, n)."""
        return self._rows([channel.values for channel in self.channels.values()])

    @cached_property
    def smooth_rows(self) -> NDArray[np.float64]:
        """Return the channels through the filter, SI, shape (channels, n)."""
        return self._rows(list(self.smooth.values()))

    def _rows(self, channels: list[NDArray[np.float64]]) -> NDArray[np.float64]:
        return np.array(channels).reshape(len(channels), self.filtered.recording.time.size)

    @cached_property
    def last(self) -> int:
        """Return the index behind the last sample within the window."""
        return int(np.searchsorted(self.filtered.recording.time, self.window.end, side="right"))

    @cached_property
    def after(self) -> dict[str, NDArray[np.float64]]:
        """Return the filtered channels within the window, SI, shape (samples of the window,) each."""
        return {name: values[self.begin : self.last] for name, values in self.smooth.items()}

    def amplitude_class(self, name: str) -> float:
        """Return a channel's amplitude class, SI."""
        return self.filtered.recording.table.kinds[name].amplitude_class or 0.0

    @cached_property
    def peaks(self) -> dict[str, float]:
        """Return the largest sizes within the window, SI."""
        return {name: float(np.abs(v).max()) if v.size else 0.0 for name, v in self.after.items()}

    @cached_property
    def bones(self) -> dict[str, list[str]]:
        """Return the gauges of each part, in the order of the legform."""
        found: dict[str, list[str]] = {}
        for name, kind in self.filtered.recording.table.kinds.items():
            if kind.part and name in self.channels:
                found.setdefault(kind.part, []).append(name)
        return found

    @cached_property
    def _shares(self) -> dict[str, float]:
        """Return the peaks of the bone moments as shares of their classes."""
        return {n: p / self.amplitude_class(n) for n, p in self.peaks.items() if self.moment(n)}

    def blow_beside(self, name: str) -> bool:
        """Tell whether the other bone moments show a blow."""
        if name not in self._blows:
            self._blows[name] = blow([share for n, share in self._shares.items() if n != name])
        return self._blows[name]

    @cached_property
    def _blows(self) -> dict[str, bool]:
        return {}

    def moment(self, name: str) -> bool:
        """Tell whether a channel is a bending moment."""
        return self.channels[name].dimension == MOMENT

    def at(self, index: int) -> float:
        """Return the time of a sample, ms."""
        return float(self.filtered.recording.time[index]) * 1e3
