"""Good recordings as laboratories make them: noise, hum, offsets, filters, sampling rates, digits; seeded."""

from __future__ import annotations

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from certkit.bench.setup import prepare
from certkit.definitions.channels import ELONGATION, MOMENT
from certkit.mechanics import simulate
from certkit.signals import Channel, Recording
from certkit.signals.cfc import cfc

Floats = NDArray[np.float64]

CASES = (
    ("pendulum", {}),
    ("inverse", {}),
    ("vehicle", {}),
    ("vehicle", {"vehicle": "generic-suv"}),
    ("vehicle", {"vehicle": "generic-sports-car"}),
)
"""Shipped procedures, and vehicles, that good recordings are made of."""
RATES = (10e3, 20e3)
FILTERS = (None, 1000, 600)
"""Classes of the analogue filter before sampling; what comes in is kept as it is with none."""
CONDITIONS = {"temperature": 293.35, "humidity": 0.42, "release angle": 0.2618}


def leg_channels(case: int) -> Recording:
    """Simulate a case and keep bone moments and elongations."""
    name, changes = CASES[case]
    setup = prepare(name, overrides=changes)
    made = simulate(setup.procedure, setup.legform, vehicle=setup.vehicle).recording
    kept = {n: c for n, c in made.channels.items() if c.dimension in {MOMENT, ELONGATION}}
    return replace(made, channels=kept)


def as_measured(made: Recording, seed: int) -> Recording:
    """Return a recording as a laboratory's data acquisition would have stored it.

    It begins 40 to 120 ms before contact. Each channel has a gain error of up to 0.5 %, an offset of up to
    2 %, white noise of 0.01 to 0.3 % and mains hum of up to 0.1 % of its amplitude class, and a digit of
    1/40000 to 1/4000 of it.
    """
    chance = np.random.default_rng(seed)
    step = 1.0 / chance.choice(RATES)
    rest = round(chance.uniform(0.04, 0.12) / step)
    time = step * np.arange(-rest, int(float(made.time[-1]) / step))
    frequency = FILTERS[chance.integers(len(FILTERS))]
    noise, hum = 10.0 ** chance.uniform(-4.0, -2.5), chance.uniform(0.0, 1e-3)
    digit = 10.0 ** chance.uniform(-4.6, -3.6)
    channels = {}
    for name, channel in made.channels.items():
        size = made.table.kinds[name].amplitude_class or 1.0
        values = np.interp(time, made.time, channel.values, left=0.0) * (1 + chance.uniform(-5e-3, 5e-3))
        values += size * chance.uniform(-0.02, 0.02)
        values += size * hum * np.sin(2 * np.pi * (50.0 * time + chance.uniform()))
        values += size * noise * chance.normal(size=time.size)
        if frequency is not None:
            values = cfc(values, step, frequency)
        values = np.round(values / (size * digit)) * (size * digit)
        channels[name] = Channel(name, channel.title, channel.dimension, values)
    return Recording(
        "measured", time, channels, conditions=CONDITIONS, table=made.table, source=f"good {seed}"
    )
