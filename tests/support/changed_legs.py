"""Recordings of a pendulum test whose leg or rig has one part changed, with a laboratory's noise; graded."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from msgspec.structs import replace

from certkit import grade, render
from certkit.bench.setup import prepare
from certkit.definitions.channels import ELONGATION, MOMENT
from certkit.exchange.channels_csv import csv_text
from certkit.mechanics import simulate
from support.laboratory_records import as_measured

LABORATORY = """\
laboratory: Example
place: Sampletown
item: {{serial: A-1}}
test: {{performed: 2026-01-{day:02}, number: {number}}}
"""

CHANGES = {
    "MCL": ("legform.knee.ligaments.MCL.stiffness", "{:.6g} kN/m", 58.0631 * 0.92, -8.0),
    "flesh": ("legform.flesh.compression", "{:.6g} MN/m²", 0.328331 * 1.15, 15.0),
    "hinge place": ("rig.hinge.offset", "{:.6g} mm", 21.5513 + 5.0, 5.0),
}
"""Path, form, value and true change (% or mm) of each part."""


def graded(
    folder: Path, overrides: dict[str, str], seed: int, gauges: Mapping[str, float] = MappingProxyType({})
) -> Path:
    """Simulate, let gauges be off by a factor, add noise, write, grade and render; return the run."""
    setup = prepare("pendulum", overrides=overrides)
    made = simulate(setup.procedure, setup.legform).recording
    kept = {
        name: replace(channel, values=gauges.get(name, 1.0) * channel.values)
        for name, channel in made.channels.items()
        if channel.dimension in {MOMENT, ELONGATION}
    }
    folder.mkdir(parents=True, exist_ok=True)
    table, header = folder / f"{seed}.csv", folder / f"{seed}.yaml"
    table.write_text(csv_text(as_measured(replace(made, channels=kept), seed)), encoding="utf-8")
    header.write_text(LABORATORY.format(day=1 + seed % 28, number=seed), encoding="utf-8")
    result = grade("pendulum", table, laboratory=header)
    render(result, folder / f"run-{seed}", "none")
    return folder / f"run-{seed}"


def changed(folder: Path, part: str, seed: int) -> tuple[Path, float]:
    """Return the run of a leg with one part changed, and the true change."""
    path, form, value, true = CHANGES[part]
    return graded(folder, {path: form.format(value)}, seed), true
