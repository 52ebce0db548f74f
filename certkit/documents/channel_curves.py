"""Curves for the result document: conditioned channels as drawn, raw channels as they were recorded."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.loading.channel_tables import default_channels
from certkit.documents.result import Histories, Series
from certkit.documents.rounding import rounded_series
from certkit.errors import DataError
from certkit.signals import Channel, Recording

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from certkit.definitions.channels import ChannelTable, Dimension
    from certkit.documents.result import Result, ResultKind
    from certkit.signals import Filtered
    from certkit.signals.recording import RecordingKind

MOST_POINTS = 600
"""Points of a drawn curve; a page is about as many pixels wide."""

BEFORE_CONTACT = 0.010
"""Seconds before contact that are drawn."""


def drawn_curves(filtered: Filtered, filters: Mapping[str, str], until: float) -> Histories | None:
    """Return the channels of a recording through their filters, thinned out for drawing.

    Parameters
    ----------
    filtered : Filtered
    filters : mapping of str to str
        Filter of each channel that has one; the others are drawn as recorded.
    until : float
        Last time that is drawn, s.

    Returns
    -------
    Histories or None
        None when nothing can be drawn. Channels that cannot be filtered are left out.
    """
    time = filtered.recording.time
    begin = int(np.searchsorted(time, -BEFORE_CONTACT - 1e-9))
    end = int(np.searchsorted(time, until + 1e-9, side="right"))
    found: dict[str, tuple[Channel, str, NDArray[np.float64]]] = {}
    for name, channel in filtered.recording.channels.items():
        words = filters.get(name, "none")
        try:
            values = filtered.values(name, words)[begin:end] * channel.dimension.scale
        except DataError:
            continue  # the criterion that needs it says so
        found[name] = (channel, channel.filtered or words if words == "none" else words, values)
    if end <= begin or not found:
        return None
    stride = -(-(end - begin) // MOST_POINTS)
    return Histories(
        start=float(time[begin]),
        interval=stride * filtered.recording.interval if end - begin > 1 else 0.0,
        count=-(-(end - begin) // stride),
        series={
            name: Series(
                title=channel.title,
                unit=channel.dimension.unit,
                values=rounded_series(thinned(values, stride)),
                filter=words,
            )
            for name, (channel, words, values) in found.items()
        },
    )


def raw_channels(recording: Recording) -> Histories | None:
    """Return the channels as recorded, at the recording's own sampling; those with NaN are left out."""
    finite = {
        name: channel
        for name, channel in recording.channels.items()
        if channel.values.shape == recording.time.shape and np.isfinite(channel.values).all()
    }
    if not finite or recording.time.size == 0:
        return None
    return Histories(
        start=float(recording.time[0]),
        interval=_mean_interval(recording.time),
        count=recording.time.size,
        series={
            name: Series(
                title=channel.title,
                unit=channel.dimension.unit,
                values=rounded_series(channel.values * channel.dimension.scale),
                filter=channel.filtered or "none",
            )
            for name, channel in finite.items()
        },
    )


RECORDED: dict[ResultKind, RecordingKind] = {
    "virtual certification": "simulated",
    "virtual test": "virtual",
    "test evaluation": "measured",
}
"""Kind of a recording by the kind of the document that was made from it."""


def simulated_here(result: Result) -> bool:
    """Tell whether a result is of a simulation of certkit itself, not of a recording that was graded."""
    recorded = any(item.role == "recording" for item in result.provenance.inputs)
    return result.kind == "virtual certification" and not recorded


def recording_of(result: Result, table: ChannelTable | None = None) -> Recording:
    """Return the recording that a result document carries, so that it can be graded again.

    Parameters
    ----------
    result : Result
    table : ChannelTable, optional
        Channels of the legform that was tested; the shipped one's when missing.

    Raises
    ------
    DataError
        When the document carries no channels.
    """
    carried = result.channels
    if carried is None:
        raise DataError(
            f"the result of `{result.procedure}` carries no channels; it cannot be graded again"
            "; grade the recording itself"
        )
    known = table or default_channels()
    channels = {}
    for name, series in carried.series.items():
        dimension = _dimension(name, series.unit, known)
        values = np.array(series.values) / dimension.scale
        seen = "" if series.filter == "none" else series.filter
        channels[name] = Channel(name, series.title, dimension, values, filtered=seen)
    time = carried.start + carried.interval * np.arange(carried.count, dtype=np.float64)
    return Recording(
        RECORDED[result.kind],
        time,
        channels,
        conditions=dict(result.conditions),
        source=result.procedure,
        table=known,
        from_solver=simulated_here(result),
    )


def thinned(values: NDArray[np.float64], stride: int) -> NDArray[np.float64]:
    """Take every `stride`-th sample, and put both extremes onto the samples nearest to them.

    So a drawn curve keeps its highest and its lowest value to the last digit, at most a drawn interval and
    a half beside their times: where both fall to one sample, the later one goes to the sample after it, or
    the earlier one to the sample before it at the curve's end. A curve that is drawn as a single sample
    keeps the value that is larger without its sign.

    Parameters
    ----------
    values : ndarray, shape (n,)
    stride : int

    Returns
    -------
    ndarray, shape (ceil(n / stride),)
    """
    drawn = values[::stride].copy()
    first, second = sorted((int(np.argmin(values)), int(np.argmax(values))))
    last = drawn.size - 1
    if last == 0:
        drawn[0] = max(values[first], values[second], key=abs)
        return drawn
    early, late = (min(last, round(index / stride)) for index in (first, second))
    if early == late and first != second:
        early, late = (early, late + 1) if late < last else (early - 1, late)
    drawn[early], drawn[late] = values[first], values[second]
    return drawn


def plane_points(x: NDArray[np.float64], y: NDArray[np.float64], most: int) -> list[tuple[float, float]]:
    """Return at most about `most` points of a curve in a plane, with its first, last and extreme ones.

    `x` and `y`, shape (n,) each, are in the units of the curve's axes, and so are the points.
    """
    stride = max(1, -(-x.size // most))
    kept = sorted({*range(0, x.size, stride), x.size - 1, *_extremes(x), *_extremes(y)})
    return [(float(x[i]), float(y[i])) for i in kept]


def _extremes(values: NDArray[np.float64]) -> Iterable[int]:
    return int(np.argmin(values)), int(np.argmax(values))


def _mean_interval(time: NDArray[np.float64]) -> float:
    return float(time[-1] - time[0]) / (time.size - 1) if time.size > 1 else 0.0


def _dimension(name: str, unit: str, table: ChannelTable) -> Dimension:
    """Return the dimension of a channel in a document by its name, else by its unit."""
    dimension = table.dimension(name, unit)
    if dimension is None:
        raise DataError(
            f"channel `{name}` has the unit `{unit}`, which certkit does not know"
            "; read it with the certkit that wrote it"
        )
    return dimension
