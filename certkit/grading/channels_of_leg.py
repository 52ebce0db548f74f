"""The channels of a leg as the plausibility gate compares them: each beside its neighbours on one leg.

Every run of a study is looked at, so that what all channels are asked for is asked once, of one table with a
row for each.
"""

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
    from certkit.signals.plausibility_motion import Products

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
        kinds, finite = self.filtered.recording.table.kinds, self.filtered.finite
        return {
            name: channel
            for name, channel in self.filtered.recording.channels.items()
            if name in kinds
            and kinds[name].amplitude_class is not None
            and channel.dimension in {MOMENT, ELONGATION}
            and channel.values.size > 1
            and name in finite
        }

    @cached_property
    def classes(self) -> dict[str, float]:
        """Return the amplitude classes, SI."""
        kinds = self.filtered.recording.table.kinds
        return {name: kinds[name].amplitude_class or 0.0 for name in self.channels}

    @cached_property
    def begin(self) -> int:
        """Return the index of contact."""
        return self._index(0.0)

    @cached_property
    def rest(self) -> int:
        """Return the index behind the last sample at rest."""
        return self._index(-MARGIN)

    @cached_property
    def end(self) -> int:
        """Return the index behind the last sample that decides, the filters' reach included."""
        return int(self.filtered.recording.time.searchsorted(self.decided + SETTLED, side="right"))

    @cached_property
    def last(self) -> int:
        """Return the index behind the last sample within the window."""
        return int(self.filtered.recording.time.searchsorted(self.window.end, side="right"))

    def _index(self, time: float) -> int:
        return int(self.filtered.recording.time.searchsorted(time))

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
    def rows(self) -> NDArray[np.float64]:
        """Return the channels as recorded, and again through the filter, SI, shape (2·channels, n)."""
        rows = [*(channel.values for channel in self.channels.values()), *self.smooth.values()]
        return np.concatenate([np.zeros(0), *rows]).reshape(len(rows), self.filtered.recording.time.size)

    @cached_property
    def after_rows(self) -> NDArray[np.float64]:
        """Return `rows` within the window, SI, shape (2·channels, samples of the window)."""
        return self.rows[:, self.begin : self.last]

    @cached_property
    def after(self) -> dict[str, NDArray[np.float64]]:
        """Return the filtered channels within the window, SI, shape (samples of the window,) each."""
        return dict(zip(self.channels, self._smooth(self.after_rows), strict=True))

    @cached_property
    def lows(self) -> dict[str, float]:
        """Return the lowest values within the window, SI; 0 where there is none."""
        after = self._smooth(self.after_rows)
        return self._by_channel(after.min(axis=1) if after.shape[1] else None)

    @cached_property
    def highs(self) -> dict[str, float]:
        """Return the highest values within the window, SI; 0 where there is none."""
        after = self._smooth(self.after_rows)
        return self._by_channel(after.max(axis=1) if after.shape[1] else None)

    @cached_property
    def peaks(self) -> dict[str, float]:
        """Return the largest sizes within the window, SI."""
        return {name: max(high, -self.lows[name]) for name, high in self.highs.items()}

    @cached_property
    def swings(self) -> dict[str, float]:
        """Return how far the channels move within the window, SI."""
        return {name: high - self.lows[name] for name, high in self.highs.items()}

    @cached_property
    def largest_steps(self) -> dict[str, float]:
        """Return the largest step from one recorded sample to the next that decides, SI; 0 without one."""
        steps = np.diff(self.rows[: len(self.channels), : self.end])
        return self._by_channel(np.abs(steps, out=steps).max(axis=1) if steps.shape[1] else None)

    def _smooth(self, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the half of `rows` that went through the filter."""
        return rows[len(self.channels) :]

    @cached_property
    def products(self) -> Products:
        """Return the sums of products of all channels within the window, SI, by both their names.

        They tell gauges that agree and lie on one line, which nearly all do, from those to look at.
        """
        after = self._smooth(self.after_rows)
        rows = [dict(zip(self.channels, row, strict=True)) for row in (after @ after.T).tolist()]
        return dict(zip(self.channels, rows, strict=True))

    @cached_property
    def means(self) -> dict[str, float]:
        """Return the means within the window, SI; 0 where there is nothing."""
        after = self._smooth(self.after_rows)
        return self._by_channel(after.mean(axis=1) if after.shape[1] else None)

    def _by_channel(self, values: NDArray[np.float64] | None) -> dict[str, float]:
        if values is None:
            return dict.fromkeys(self.channels, 0.0)
        return dict(zip(self.channels, values.tolist(), strict=True))

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
        return {n: p / self.classes[n] for n, p in self.peaks.items() if self.moment(n)}

    def blow_beside(self, name: str) -> bool:
        """Tell whether the other bone moments show a blow."""
        left_out = name if name in self._shares else ""  # beside all others stand the same
        if left_out not in self._blows:
            self._blows[left_out] = blow([share for n, share in self._shares.items() if n != left_out])
        return self._blows[left_out]

    @cached_property
    def _blows(self) -> dict[str, bool]:
        return {}

    def moment(self, name: str) -> bool:
        """Tell whether a channel is a bending moment."""
        return self.channels[name].dimension == MOMENT

    def at(self, index: int) -> float:
        """Return the time of a sample, ms."""
        return float(self.filtered.recording.time[index]) * 1e3
