# ruff: noqa: INP001  # a script beside its data
"""Make the made-up certification tests in this folder: the shipped model's curves, with noise and offsets.

They are called measured to show the way from a recording to a certificate; no legform was tested.
Run it from the top of a checkout: `python examples/certification/make.py`. The pendulum test is the one of
`examples/measured`.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from certkit.bench.setup import prepare
from certkit.definitions.channels import ELONGATION, MOMENT
from certkit.exchange.mme_write import write_mme
from certkit.mechanics import simulate
from certkit.signals import Recording

HERE = Path(__file__).parent
CONDITIONS = {
    "static-femur": {"temperature": 293.65, "deflection rate": 0.5e-3, "support span": 0.33},
    "static-tibia": {"temperature": 293.55, "deflection rate": 0.5e-3, "support span": 0.41},
    "static-knee": {"temperature": 293.65, "deflection rate": 0.5e-3, "support span": 0.4},
    "inverse": {"temperature": 293.85, "speed": 11.1, "ram mass": 8.152},
}
LOADED = {
    "static-femur": {"rig.loading ram.force": "4700 N"},
    "static-tibia": {"rig.loading ram.force": "3790 N"},
}
RATE, REST = 1e-4, 0.03
NOISE, OFFSET = 0.0008, 0.003  # of the largest value


def measured(name: str, seed: int) -> Recording:
    """Return a simulated test as a data recorder would have stored it, called measured."""
    setup = prepare(name, overrides=LOADED.get(name))
    made = simulate(setup.procedure, setup.legform).recording
    chance = np.random.default_rng(seed)
    static = setup.procedure.test_kind == "static"
    time = made.time if static else RATE * np.arange(-round(REST / RATE), int(made.time[-1] / RATE))
    channels = {}
    for key, channel in made.channels.items():
        if not static and channel.dimension not in {MOMENT, ELONGATION}:
            continue
        values = channel.values if static else np.interp(time, made.time, channel.values, left=0.0)
        size = float(np.abs(values).max())
        noise = NOISE * chance.normal(size=time.size) * (0.25 if static else 1.0)
        values = values + size * (noise + (0.0 if static else OFFSET * chance.uniform(-1, 1)))
        channels[key] = replace(channel, values=np.round(values, 2 if channel.dimension is MOMENT else 7))
    return Recording("measured", time, channels, conditions=CONDITIONS[name], table=made.table)


if __name__ == "__main__":
    for number, test in enumerate(CONDITIONS):
        header = {"Laboratory name": "Example Crash Laboratory", "Title": f"FLX-0007 {test}, made-up data"}
        write_mme(measured(test, number), HERE / f"FLX-0007-{test}.zip", header=header)
