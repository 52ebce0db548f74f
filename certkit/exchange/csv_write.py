"""Write a recording as CSV: time in s, one column a channel, conditions in `#` lines before the heads."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.units import UNITS
from certkit.exchange.codes import code_table
from certkit.files import write_whole

if TYPE_CHECKING:
    from pathlib import Path

    from certkit.signals.recording import Recording


def csv_text(recording: Recording) -> str:
    """Return the recording as CSV, nine digits a number; `read_csv` reads it without a mapping file."""
    remarks = [f"# kind: {recording.kind}\n"]
    table = code_table()
    for word, value in sorted(recording.conditions.items()):
        if word in table.conditions:
            units = UNITS[table.conditions[word].dimension]
            unit = next(unit for unit, scale in units.items() if scale == 1.0)
            remarks.append(f"# {word}: {value:.9g} {unit}".rstrip() + "\n")
    channels = list(recording.channels.values())
    remarks += [f"# filter {channel.name}: {channel.filtered}\n" for channel in channels if channel.filtered]
    heads = ["time [s]", *(f"{channel.name} [{channel.dimension.unit}]" for channel in channels)]
    columns = [recording.time, *(channel.values * channel.dimension.scale for channel in channels)]
    form = ",".join(["%.9g"] * len(columns)) + "\n"
    rows = [form % tuple(row) for row in np.column_stack(columns).tolist()]
    return "".join(remarks) + ",".join(heads) + "\n" + "".join(rows)


def write_csv(recording: Recording, path: Path) -> None:
    """Write the recording as CSV; see `csv_text`."""
    write_whole(path, csv_text(recording))
