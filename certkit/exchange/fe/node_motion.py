"""Motion of nodes on a front's middle line: how its faces change their form as they are pushed in."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.fe.numeric_table import read_cells

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    Values = NDArray[np.float64]

COLUMNS = ("time_ms", "node", "line", "x_mm", "z_mm")
FOUND_BY_NAME = "animation*.csv*"


class NodeMotion(Struct, frozen=True):
    """Places of nodes over time, in m and s.

    Parameters
    ----------
    time : ndarray, shape (n,)
    places : dict of str to dict of str to ndarray, shape (n, 2)
        (x, z) over time by node, by the part or line that the node belongs to.
    source : str
        The file.
    """

    time: Values
    places: dict[str, dict[str, Values]]
    source: str = ""


def read_node_motion(path: Path) -> tuple[NodeMotion, str]:
    """Read a table with the columns time_ms, node, line, x_mm and z_mm, one row an instant and node.

    Returns
    -------
    NodeMotion
    str
        SHA-256 of the file.

    Raises
    ------
    DataError
        For a missing column, a cell that is no number, or a node that lacks an instant.
    """
    rows, digest = read_cells(path)
    missing = [name for name in COLUMNS if name not in rows[0]]
    if missing:
        raise DataError(
            f"{path}: the column `{missing[0]}` is missing; there have to be {', '.join(COLUMNS)}"
        )
    series: dict[tuple[str, str], list[tuple[float, float, float]]] = {}
    for number, row in enumerate(rows, start=2):
        try:
            values = (float(row["time_ms"]), float(row["x_mm"]), float(row["z_mm"]))
        except ValueError:
            raise DataError(
                f"{path}:{number}: time and place have to be numbers; export them again"
            ) from None
        if not np.all(np.isfinite(values)):
            raise DataError(f"{path}:{number}: a place that is not finite; export the nodes again")
        series.setdefault((row["line"], row["node"]), []).append(values)
    time: Values | None = None
    places: dict[str, dict[str, Values]] = {}
    for (line, node), points in series.items():
        table = 1e-3 * np.array(sorted(points))
        if time is None:
            time = table[:, 0]
        if table.shape[0] != time.size or not np.allclose(table[:, 0], time, rtol=0, atol=1e-9):
            raise DataError(
                f"{path}: node `{node}` has not the same instants as the others"
                "; export all nodes at the same instants"
            )
        places.setdefault(line, {})[node] = table[:, 1:]
    if time is None or time.size < 3 or np.any(np.diff(time) <= 0):
        raise DataError(f"{path}: too few instants, or an instant twice; export it again")
    return NodeMotion(time, places, str(path)), digest
