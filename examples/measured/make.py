# ruff: noqa: INP001  # a script beside its data
"""Make the made-up measured test in this folder: pulses with noise and offsets, no real legform.

Run it from the top of a checkout: `python examples/measured/make.py`.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from certkit.exchange.mme_write import write_mme
from certkit.signals import CHANNELS, Channel, Recording

HERE = Path(__file__).parent
PEAKS = {
    "F1": 176.0,
    "F2": 121.0,
    "F3": 62.0,
    "T1": 254.0,
    "T2": 203.0,
    "T3": 152.0,
    "T4": 100.5,
    "MCL": 0.0223,
    "ACL": 0.0092,
    "PCL": 0.0042,
    "LCL": -0.0031,
}
OFFSET, NOISE = 0.004, 0.0015  # of the peak


def recording() -> Recording:
    """Return a pendulum test: pulses of about 90 ms with a small second swing, noise and offsets."""
    chance = np.random.default_rng(7)
    time = np.round(-0.03 + 1e-4 * np.arange(2000), 9)
    after = np.clip(time, 0.0, None)
    channels = {}
    for name, peak in PEAKS.items():
        kind = CHANNELS[name]
        rise = 0.052 if name[0] in "FT" else 0.058
        pulse = (after / rise) ** 2 * np.exp(2 * (1 - after / rise)) + 0.03 * np.sin(after / 0.009) * np.exp(
            -after / 0.03
        )
        values = peak * (
            pulse / pulse.max() + OFFSET * chance.uniform(-1, 1) + NOISE * chance.normal(size=time.size)
        )
        digits = 2 if kind.dimension.name == "moment" else 6
        channels[name] = Channel(name, kind.title, kind.dimension, np.round(values, digits))
    conditions = {
        "temperature": 293.75,
        "humidity": 0.46,
        "release angle": np.deg2rad(15.1),
        "added mass": 5.004,
    }
    return Recording("measured", time, channels, conditions=conditions)


def write_table(test: Recording, path: Path) -> None:
    """Write tibia and ligament channels as a German logger would: semicolons, commas, ms, its own signs."""
    names = ("T1", "T2", "T3", "T4", "MCL", "ACL", "PCL")
    heads = ["Zeit", *(f"Kanal {number}" for number in range(1, 8))]
    lines = ["Prüfung;FLX-0007 Pendel", ";".join(heads), "ms" + ";Nm" * 4 + ";mm" * 3]
    for index, time in enumerate(test.time):
        signs = [-1.0] * 4 + [1e3] * 3
        cells = [f"{time * 1e3:.1f}"]
        cells += [f"{test[n].values[index] * s:.3f}" for n, s in zip(names, signs, strict=True)]
        lines.append(";".join(cells).replace(".", ","))
    path.write_text("\n".join(lines) + "\n", encoding="cp1252")


if __name__ == "__main__":
    test = recording()
    header = {"Laboratory name": "Example Crash Laboratory", "Title": "FLX-0007 pendulum, made-up data"}
    write_mme(test, HERE / "FLX-0007-pendulum.zip", header=header)
    write_table(replace(test, conditions={}), HERE / "FLX-0007-pendulum.csv")
