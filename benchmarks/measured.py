"""Measured tests: grading 100 recordings of 7 × 20,000 samples, over the time numpy needs to read them."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from clock import Row, processor_seconds

import certkit
from certkit.definitions.loading.channel_tables import default_channels
from certkit.exchange.channels_csv import csv_text
from certkit.exchange.mme_write import write_mme
from certkit.signals import Channel, Recording

if TYPE_CHECKING:
    from collections.abc import Iterator

RECORDINGS, SAMPLES, DISTINCT = 100, 20_000, 10
PEAKS = {"T1": 250.0, "T2": 200.0, "T3": 150.0, "T4": 100.0, "MCL": 0.022, "ACL": 0.009, "PCL": 0.004}


def recording(seed: int) -> Recording:
    """Return a pendulum-like test at 100 kHz with some noise."""
    chance = np.random.default_rng(seed)
    time = -0.02 + 1e-5 * np.arange(SAMPLES)
    kinds = default_channels().kinds
    pulse = np.where((time > 0) & (time < 0.1), np.sin(np.pi * time / 0.1), 0.0)
    channels = {
        name: Channel(
            name,
            kinds[name].title,
            kinds[name].dimension,
            peak * (pulse + 1e-3 * chance.normal(size=SAMPLES)),
        )
        for name, peak in PEAKS.items()
    }
    conditions = {"temperature": 293.15, "release angle": 0.2618, "added mass": 5.0, "humidity": 0.4}
    return Recording("measured", time, channels, conditions=conditions)


def _read(paths: list[Path]) -> None:
    for path in paths:
        np.loadtxt(path, delimiter=",", comments="#", skiprows=6)


def _grade(paths: list[Path]) -> None:
    for path in paths:
        certkit.grade("pendulum", path)


def rows() -> Iterator[Row]:
    """Yield the ratio for CSV, and for ISO-MME archives over the same reading of CSV."""
    with tempfile.TemporaryDirectory() as folder:
        tables, archives = [], []
        for number in range(RECORDINGS):
            table, archive = Path(folder, f"{number}.csv"), Path(folder, f"{number}.zip")
            if number < DISTINCT:
                test = recording(number)
                table.write_bytes(csv_text(test).encode())
                write_mme(test, archive)
            else:
                shutil.copyfile(Path(folder, f"{number % DISTINCT}.csv"), table)
                shutil.copyfile(Path(folder, f"{number % DISTINCT}.zip"), archive)
            tables.append(table)
            archives.append(archive)
        read = processor_seconds(lambda: _read(tables), 2)
        yield Row("numpy reads 100 recordings of 7 × 20,000 from CSV", read, "s")
        yield Row(
            "grading them, over reading them", processor_seconds(lambda: _grade(tables), 2) / read, "", 30
        )
        graded = processor_seconds(lambda: _grade(archives), 1)
        yield Row("grading them from ISO-MME archives, over reading the CSV", graded / read, "", 30)
