"""One time axis for all channels of a test."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from msgspec.structs import force_setattr, replace

from certkit.documents.rounding import rounded
from certkit.errors import DataError
from certkit.files.limits import MAX_SAMPLES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from certkit.exchange.leniency import Leniency

_SAME = 1e-6  # relative difference of two intervals that count as one
_UNIFORM = 0.2  # of an interval: rounding in a written time column; a lost sample shows as 0.5


class TimeBase(Struct, frozen=True):
    """A uniform time axis: time of the first sample (s), interval (s) and number of samples.

    Both times have the seven digits that a result document keeps, so that the samples that lie on the edge of
    a window are the same when a document is graded again.
    """

    first: float
    interval: float
    count: int

    def __post_init__(self) -> None:
        """Round the times."""
        force_setattr(self, "first", rounded(self.first))
        force_setattr(self, "interval", rounded(self.interval))

    def with_count(self, count: int) -> TimeBase:
        """Return the axis with another number of samples."""
        return replace(self, count=count)

    @property
    def last(self) -> float:
        """Time of the last sample, s."""
        return self.first + self.interval * (self.count - 1)

    def times(self) -> NDArray[np.float64]:
        """Return the axis, shape (count,)."""
        return self.first + self.interval * np.arange(self.count, dtype=np.float64)

    def same_as(self, other: TimeBase) -> bool:
        """Tell whether two axes are one."""
        return (
            self.count == other.count
            and abs(self.interval - other.interval) <= _SAME * self.interval
            and abs(self.first - other.first) <= 1e-3 * self.interval
        )

    @property
    def words(self) -> str:
        """Return `20000 samples every 0.05 ms from -10 ms`."""
        return f"{self.count} samples every {self.interval * 1e3:.7g} ms from {self.first * 1e3:.7g} ms"


def common_base(
    parts: Mapping[str, tuple[TimeBase, NDArray[np.float64]]], leniency: Leniency
) -> tuple[TimeBase, dict[str, NDArray[np.float64]]]:
    """Bring channels to one axis.

    Parameters
    ----------
    parts : mapping of str to (TimeBase, ndarray of shape (n,))
        Axis (s) and values, SI, by the place messages name.
    leniency : Leniency
        Several axes are an error, or are brought by linear interpolation to the finest one over the time that
        all cover.

    Returns
    -------
    (TimeBase, dict of str to ndarray)
        The axis, and the values on it.

    Raises
    ------
    DataError
        When there are several and reading is strict, or when they share no time.
    """
    (first_place, (base, _)), *rest = parts.items()
    odd = [(place, other) for place, (other, _) in rest if not other.same_as(base)]
    if not odd:
        return base, {place: values for place, (_, values) in parts.items()}
    place, other = odd[0]
    leniency.depart(
        place,
        f"{other.words}, but {first_place.rpartition('/')[2]} has {base.words}: two time bases",
        "linear interpolation to the finest interval over the time that all channels cover",
    )
    begin = max(axis.first for axis, _ in parts.values())
    end = min(axis.last for axis, _ in parts.values())
    step = min(axis.interval for axis, _ in parts.values())
    count = int((end - begin) / step + 1e-6) + 1 if end > begin else 0
    if not 2 <= count <= MAX_SAMPLES:
        raise DataError(
            f"{place}: shares no time with {first_place}; these are not channels of one test: take "
            "the wrong one out"
        )
    shared = TimeBase(begin, step, count)
    times = shared.times()
    return shared, {name: np.interp(times, axis.times(), values) for name, (axis, values) in parts.items()}


def base_of_times(times: NDArray[np.float64], place: str, first_line: int) -> TimeBase:
    """Recognise a uniform axis in a time column, shape (n,), s.

    Raises
    ------
    DataError
        When the times do not rise in equal steps, with the line of the first that does not.
    """
    if times.size < 2:
        raise DataError(f"{place}:{first_line}: a single sample; a test has many: export it again")
    interval = float(times[-1] - times[0]) / (times.size - 1)
    steps = np.diff(times)
    if interval <= 0 or (steps <= 0).any():
        line = first_line + 1 + int(np.argmax(steps <= 0))
        raise DataError(
            f"{place}:{line}: time does not rise; is the right column mapped, and is it one test? "
            "Correct the mapping or the file"
        )
    expected = times[0] + interval * np.arange(times.size)
    off = np.abs(times - expected) > max(_UNIFORM * interval, 1e-9)
    if off.any():
        line = first_line + int(np.argmax(off))
        raise DataError(
            f"{place}:{line}: the sampling is not uniform; export the channels with one sampling interval"
        )
    return TimeBase(float(times[0]), interval, times.size)
