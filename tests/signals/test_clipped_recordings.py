"""How many clipped channels of real length and shape are found: the shipped measured tests, cut off."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest

from certkit.exchange.read import read_recording
from certkit.signals.clipping import SMALL, find_clippings

EXAMPLES = Path(__file__).parents[2] / "examples"
TESTS = ("measured/FLX-0007-pendulum", "certification/FLX-0007-inverse", "campaign/L+1", "campaign/L-5")


@cache
def measured() -> list[tuple[np.ndarray, list[float]]]:
    """Return the channels of each test that show something, turned so that the peak is positive."""
    found = []
    for name in TESTS:
        rec = read_recording(EXAMPLES / f"{name}.zip").recording
        limits = {n: rec.table.kinds[n].amplitude_class for n in rec.channels if n in rec.table.kinds}
        rows = {n: rec[n].values for n, limit in limits.items() if limit}
        rows = {n: row for n, row in rows.items() if np.abs(row).max() >= SMALL * (limits[n] or 0.0)}
        turned = [row if row.max() >= -row.min() else -row for row in rows.values()]
        found.append((np.array(turned), [float(limits[n] or 0.0) for n in rows]))
    return found


@pytest.mark.parametrize(("share", "least"), [(1.0, 0.0), (0.99, 0.5), (0.95, 0.9), (0.9, 0.95), (0.7, 0.9)])
def test_clipped_channels_are_found_and_whole_ones_are_not(share: float, least: float):
    hits = total = 0
    for rows, limits in measured():
        cut = np.minimum(rows, share * rows.max(axis=1, keepdims=True)) if share < 1.0 else rows
        hits += sum(each is not None for each in find_clippings(cut, limits))
        total += len(rows)
    assert total > 30
    assert hits / total >= least
    assert hits == 0 or share < 1.0
