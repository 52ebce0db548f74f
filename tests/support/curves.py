"""Curves that the tests of this folder share."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from certkit.definitions.loading.channel_tables import default_channels
from certkit.exchange.channels_csv import csv_text
from certkit.signals import Channel, Recording

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.signals.recording import RecordingKind

Floats = NDArray[np.float64]


def half_sine(time: Floats, peak: float, *, duration: float = 0.06, start: float = 0.0):
    """Return one half wave of `duration` (s) from `start` on, zero before and after."""
    inside = (time >= start) & (time <= start + duration)
    return np.where(inside, peak * np.sin(np.pi * (time - start) / duration), 0.0)


def channel(name: str, values: ArrayLike, *, filtered: str = ""):
    kind = default_channels().kinds[name]
    return Channel(name, kind.title, kind.dimension, np.asarray(values, dtype=float), filtered)


def recording(time: ArrayLike, values: dict[str, ArrayLike], *, kind: RecordingKind = "measured"):
    channels = {name: channel(name, v) for name, v in values.items()}
    return Recording(kind, np.asarray(time, dtype=float), channels)


def write_csv(recording: Recording, path: Path) -> None:
    path.write_bytes(csv_text(recording).encode())
