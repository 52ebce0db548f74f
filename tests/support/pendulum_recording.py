"""A plausible recording of a pendulum test."""

from __future__ import annotations

import numpy as np

from certkit.definitions.loading.channel_tables import default_channels
from certkit.signals import Channel, Recording

KINDS = default_channels().kinds

PEAKS = {"T1": 250.0, "T2": 200.0, "T3": 150.0, "T4": 100.0, "MCL": 0.022, "ACL": 0.009, "PCL": 0.004}
CONDITIONS = {"temperature": 293.35, "humidity": 0.42, "release angle": 0.2618}


def pendulum_like(count: int = 2500, interval: float = 1e-4, first: float = -0.05) -> Recording:
    """Half-sine pulses of 80 ms after contact, with the peaks of a certified leg."""
    time = first + interval * np.arange(count)
    pulse = np.where((time > 0) & (time < 0.08), np.sin(np.pi * np.clip(time, 0, 0.08) / 0.08), 0.0)
    channels = {
        name: Channel(name, KINDS[name].title, KINDS[name].dimension, peak * pulse)
        for name, peak in PEAKS.items()
    }
    return Recording("measured", time, channels, conditions=CONDITIONS)
