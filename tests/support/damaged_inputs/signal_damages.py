"""Damages of a recording's samples that the samples themselves show.

What no file can show is left out: a factor of a few per cent on one channel, the exchange of two channels
whose corridors both hold either, an offset that is there from the first sample on.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from msgspec.structs import replace

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    from certkit.signals import Recording

    Values = NDArray[np.float64]
    Change = Callable[[Values, Values, np.random.Generator], Values]

GRADED = ("T1", "T2", "T3", "T4", "MCL", "ACL", "PCL")
POWERS = (1e-6, 1e-3, 1e-2, 0.1, 10.0, 100.0, 1e3)
SWAPS = (("T1", "T2"), ("T1", "T3"), ("T1", "T4"), ("T2", "T3"), ("T2", "T4"), ("T3", "T4"))
SWAPS += (("MCL", "ACL"), ("MCL", "PCL"), ("T1", "MCL"), ("T4", "ACL"))


@dataclass(frozen=True)
class SignalDamage:
    """A kind, its parameters in words, and the recording it makes."""

    kind: str
    name: str
    recording: Recording


def signal_damages(intact: Recording, chance: np.random.Generator) -> Iterator[SignalDamage]:
    """Yield every damage of a recording; `chance` draws what a damage leaves open."""
    first, last = float(intact.time[0]), float(intact.time[-1])
    for end in np.arange(0.002, last, 0.004) + chance.uniform(0, 0.002):
        yield SignalDamage("truncated", f"ends at {end * 1e3:.1f} ms", _cut(intact, first, float(end)))
    for begin in np.arange(first + 0.001, 0.12, 0.006) + chance.uniform(0, 0.002):
        yield SignalDamage("truncated", f"begins at {begin * 1e3:.1f} ms", _cut(intact, float(begin), last))
    for factor in POWERS:
        scaled = _each(intact, GRADED, lambda v, _t, _c, f=factor: f * v, chance)
        yield SignalDamage("scaled", f"all by {factor:g}", scaled)
    yield SignalDamage("inverted", "all", _each(intact, GRADED, lambda v, _t, _c: -v, chance))
    for one, other in SWAPS:
        channels = dict(intact.channels)
        a, b = intact[one], intact[other]
        channels[one] = replace(a, values=b.values / b.dimension.scale * a.dimension.scale)
        channels[other] = replace(b, values=a.values / a.dimension.scale * b.dimension.scale)
        yield SignalDamage("swapped", f"{one} and {other}", replace(intact, channels=channels))
    for name in GRADED:
        for factor in POWERS:
            changed = _each(intact, (name,), lambda v, _t, _c, f=factor: f * v, chance)
            yield SignalDamage("scaled", f"{name} by {factor:g}", changed)
        for kind, words, change in _changes(intact, name, chance):
            yield SignalDamage(kind, f"{name} {words}", _each(intact, (name,), change, chance))


def _changes(intact: Recording, name: str, chance: np.random.Generator) -> Iterator[tuple[str, str, Change]]:
    values, time = intact[name].values, intact.time
    peak = int(np.argmax(np.abs(values)))
    at_peak = float(time[peak])
    top = float(values[peak])
    yield "inverted", "inverted", lambda v, _t, _c: -v
    yield "dropped", "all zero", lambda v, _t, _c: np.zeros_like(v)
    yield "frozen", "constant", lambda v, _t, _c: np.full_like(v, v[0])
    yield "frozen", "noise alone", lambda v, _t, c: c.normal(0, 1e-3 * abs(top), v.size)
    for at in (*chance.uniform(0.0, at_peak, 3), *chance.uniform(at_peak, 0.15, 1)):
        yield "frozen", f"frozen from {at * 1e3:.1f} ms", lambda v, t, _c, a=at: _frozen(v, t, a)
        yield "dropped", f"zero from {at * 1e3:.1f} ms", lambda v, t, _c, a=at: np.where(t < a, v, 0.0)
    for width in (1, 3, 12):
        window = slice(max(peak - width // 2, 0), peak + width // 2 + 1)
        yield "dropped", f"zero in {width} samples at the peak", lambda v, _t, _c, w=window: _put(v, w, 0.0)
    for factor in (3.0, -8.0, 40.0):
        index = int(chance.integers(peak // 2, peak + 20))
        yield (
            "overflow",
            f"{factor:g} peaks in sample {index}",
            lambda v, _t, _c, i=index, f=factor: _put(v, slice(i, i + 1), f * top),
        )
    for part in chance.uniform(0.3, 0.93, 3):
        yield "clipped", f"at {part:.2f} of the peak", lambda v, _t, _c, p=part: _clipped(v, p * top)
        yield (
            "clipped",
            f"at {part:.2f} of the peak, with noise",
            lambda v, _t, c, p=part: (
                _clipped(v, p * top)
                + np.where(np.abs(v) > abs(p * top), c.normal(0, 2e-4 * abs(top), v.size), 0.0)
            ),
        )
    for by in (-30e-3, -15e-3, 15e-3, 60e-3):
        yield "shifted", f"by {by * 1e3:g} ms", lambda v, t, _c, b=by: np.interp(t - b, t, v)


def _each(
    recording: Recording, names: tuple[str, ...], change: Change, chance: np.random.Generator
) -> Recording:
    channels = dict(recording.channels)
    for name in names:
        values = change(channels[name].values, recording.time, chance)
        channels[name] = replace(channels[name], values=values)
    return replace(recording, channels=channels)


def _cut(recording: Recording, begin: float, end: float) -> Recording:
    kept = (recording.time >= begin) & (recording.time <= end)
    channels = {n: replace(c, values=c.values[kept]) for n, c in recording.channels.items()}
    return replace(recording, time=recording.time[kept], channels=channels)


def _frozen(values: Values, time: Values, at: float) -> Values:
    index = int(np.searchsorted(time, at))
    return np.where(time < at, values, values[min(index, values.size - 1)])


def _put(values: Values, where: slice, value: float) -> Values:
    changed = values.copy()
    changed[where] = value
    return changed


def _clipped(values: Values, level: float) -> Values:
    return np.minimum(values, level) if level > 0 else np.maximum(values, level)
