"""LS-DYNA binouts, written for tests with lasso-python's writer: none comes from LS-DYNA."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from pathlib import Path


def matsum(time: np.ndarray, ids: tuple[int, ...]) -> dict:
    """Return parts whose mass is their id and whose speed falls, each at its own rate; kg, mm, ms."""
    speed = np.stack([10.0 - number * time for number in ids], axis=1)
    mass = np.tile(np.array(ids, float), (time.size, 1))
    return {
        "ids": ids,
        "titles": [f"part {number}" for number in ids],
        "time": time,
        "mass": mass,
        "x_rbvelocity": speed,
        "x_momentum": mass * speed,
    }


def rcforc(time: np.ndarray, ids: tuple[int, ...]) -> dict:
    """Return contacts that push with their id, each once a side."""
    force = np.stack([sign * number + 0 * time for number in ids for sign in (1, -1)], axis=1)
    both = tuple(number for number in ids for _ in range(2))
    titles = [f"contact {number}" for number in both]
    return {"ids": both, "titles": titles, "time": time, "x_force": force}


def glstat(time: np.ndarray) -> dict:
    """Return energies."""
    return {"time": time, "kinetic_energy": 100.0 - time, "internal_energy": time}


def write(path: Path, *, split: float | None = None, **tables: dict) -> Path:
    """Write a binout; from the time `split` on it goes on in a file `…%001`."""
    from lasso.dyna.lsda_py3 import Lsda  # noqa: PLC0415  # optional

    file = Lsda(str(path), "w")
    for name, table in tables.items():
        file.cd(f"/{name}/metadata")
        file.write("title", Lsda.I1, f"{'not written by LS-DYNA':80}".encode())
        if "ids" in table:
            file.write("ids", Lsda.I4, table["ids"])
            file.write("legend_ids", Lsda.I4, table["ids"])
            file.write("legend", Lsda.I1, "".join(f"{title:80}" for title in table["titles"]).encode())
    for after in (False, True):
        if after and split is not None:
            file.nextfile()
        for name, table in tables.items():
            for row, time in enumerate(table["time"]):
                if (split is not None and time >= split) != after:
                    continue
                file.cd(f"/{name}/d{row + 1:06d}")
                file.write("time", Lsda.R8, [float(time)])
                for variable in table.keys() - {"ids", "titles", "time"}:
                    file.write(variable, Lsda.R8, np.atleast_1d(table[variable][row]).tolist())
    file.close()
    return path
