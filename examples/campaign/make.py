# ruff: noqa: INP001  # a script beside its data
"""Make the made-up measured tests in this folder: simulations of a changed front with noise, no real car.

Run it from the top of a checkout: `python examples/campaign/make.py`.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

import certkit
from certkit.documents.channel_curves import recording_of
from certkit.exchange.mme_write import write_mme
from certkit.signals import Recording

HERE = Path(__file__).parent
SPRINGS = "vehicle.springs."
TESTS = {
    "L-5": {f"{SPRINGS}middle foam.loading.30 mm": "1900 N", f"{SPRINGS}lower foam.loading.28 mm": "1500 N"},
    "L+1": {f"{SPRINGS}middle foam.loading.30 mm": "1200 N"},
    "L+4": {f"{SPRINGS}middle foam.loading.30 mm": "3600 N", f"{SPRINGS}lower foam.loading.28 mm": "3600 N"},
    "L+4-foam-2": {f"{SPRINGS}middle foam.loading.30 mm": "1500 N"},
}
CHANNELS = ("T1", "T2", "T3", "T4", "MCL", "ACL", "PCL", "F1", "F2", "F3")
STRIDE, BEFORE = 2, 0.034
"""Every second sample of the simulation, and seconds of free flight before contact."""
CONDITIONS = {
    "speed": 11.12,
    "temperature": 293.25,
    "humidity": 0.42,
}


def measured(changes: dict[str, str], seed: int) -> Recording:
    """Return the channels of a simulation as a laboratory would have recorded them: with noise."""
    result = certkit.run("vehicle", overrides={"vehicle": "generic-suv", **changes}, refine=False)
    made = recording_of(result)
    chance = np.random.default_rng(seed)
    after = made.time[::STRIDE]
    step = after[1] - after[0]
    before = step * np.arange(-round(BEFORE / step), 0)
    channels = {}
    for name in CHANNELS:
        values = np.concatenate([np.zeros(before.size), made[name].values[::STRIDE]])
        noise = 0.0015 * np.abs(values).max() * chance.normal(size=values.size)
        digits = 2 if made[name].dimension.name == "moment" else 6
        channels[name] = replace(made[name], values=np.round(values + noise, digits))
    return Recording(
        "measured", np.round(np.concatenate([before, after]), 9), channels, conditions=CONDITIONS
    )


if __name__ == "__main__":
    for number, (name, changes) in enumerate(TESTS.items(), 1):
        header = {"Laboratory name": "Example Crash Laboratory", "Title": f"{name}, made-up data"}
        write_mme(measured(changes, number), HERE / f"{name}.zip", header=header)
