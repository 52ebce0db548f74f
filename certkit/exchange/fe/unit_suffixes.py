"""Units at the ends of columns' names, `T1_Nm`, in tidy tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from certkit.errors import DataError
from certkit.exchange.fe.checks import require_time_axis
from certkit.exchange.fe.histories import match_one

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from certkit.exchange.fe.numeric_table import NumericTable

    Values = NDArray[np.float64]

SUFFIXES = {
    "ms": ("time", 1e-3), "s": ("time", 1.0), "mm": ("length", 1e-3), "cm": ("length", 1e-2),
    "m": ("length", 1.0), "Ns": ("momentum", 1.0), "kNs": ("momentum", 1e3), "kNms": ("momentum", 1.0),
    "N": ("force", 1.0), "kN": ("force", 1e3), "J": ("energy", 1.0), "kJ": ("energy", 1e3),
    "mJ": ("energy", 1e-3), "Nm": ("moment", 1.0), "Nmm": ("moment", 1e-3), "kNmm": ("moment", 1.0),
    "kNm": ("moment", 1e3), "deg": ("angle", 0.017453292519943295), "rad": ("angle", 1.0),
    "mps": ("speed", 1.0), "mmps": ("speed", 1e-3),
}  # fmt: skip
"""Unit at the end of a column's name → dimension and factor to SI."""


def time_axis(table: NumericTable, name: str) -> Values:
    """Return a table's time, shape (n,), s; the name of its column has to end in the unit."""
    if name not in table.columns:
        match_one(name, table.columns, "column", table.source)
    suffix = name.rsplit("_", 1)[-1]
    if SUFFIXES.get(suffix, ("",))[0] != "time":
        raise DataError(f"{table.source}: the time column `{name}` must end in _ms or _s; rename it")
    time: Values = table.columns[name] * SUFFIXES[suffix][1]
    require_time_axis(time, table.source)
    return time
