"""A run as LS-DYNA binout files: any table's variables by title or id, nodes' distances, and `glstat`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.binout_files import BinoutFiles
from certkit.exchange.fe.binout_tables import BinoutTables
from certkit.exchange.fe.histories import match_one
from certkit.exchange.fe.run_histories import Samples, combined, factor_of, growth_of_distance

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from certkit.definitions.virtual_test import History
    from certkit.exchange.fe.histories import Units

ENERGIES = {
    "kinetic": "kinetic_energy",
    "internal": "internal_energy",
    "hourglass": "hourglass_energy",
    "contact": "sliding_interface_energy",
    "external work": "external_work",
    "total": "total_energy",
}
"""Energy → its variable in `glstat`."""
AXES = ("x", "y", "z")


class BinoutRun:
    """Tables of one or several binouts."""

    def __init__(self, paths: Sequence[Path], units: Units) -> None:
        """Open the binouts.

        Raises
        ------
        DataError
            Without lasso-python, or for a file that is no binout.
        """
        self._units = units
        self._source = ", ".join(str(path) for path in paths)
        self._opened = BinoutFiles(paths)
        self._tables = BinoutTables(self._opened, self._source)

    @property
    def files(self) -> Mapping[str, str]:
        """SHA-256 of every file that was read, by its name."""
        return self._opened.digests

    @property
    def remarks(self) -> tuple[str, ...]:
        """What there is to say of the files and of how they were joined."""
        return tuple(self._tables.remarks())

    def close(self) -> None:
        """Forget the copies that were made to read from."""
        self._opened.close()

    def history(self, asked: History, dimension: str) -> Samples:
        """Return a variable of objects, or the growth of two nodes' distance."""
        if asked.between is not None:
            nodes = [self._node(name) for name in asked.between]
            grown = growth_of_distance(nodes[0][1:], nodes[1][1:], nodes[0][0])
            return Samples(grown.time, grown.values * factor_of(self._units, dimension))
        if asked.table is None:
            raise DataError(
                f"{self._source}: a binout has tables, no columns; map `table`, `of` and `variable`"
            )
        parts = [self._variable(asked.table, name, asked.variable or "") for name in asked.objects]
        found = combined(parts, asked.combine)
        return Samples(found.time, found.values * factor_of(self._units, dimension))

    def energies(self) -> Mapping[str, Samples]:
        """Return the energies of `glstat`."""
        found: dict[str, Samples] = {}
        tables, units = self._tables, self._units
        if tables.has_table("glstat"):
            time = tables.times("glstat", units.time)
            wanted = {name: (variable, units.energy) for name, variable in ENERGIES.items()}
            wanted |= {"ratio": ("energy_ratio", 1.0)}
            wanted |= {"added mass": ("added_mass", units.mass), "mass": ("mass", units.mass)}
            for name, (variable, factor) in wanted.items():
                if tables.has("glstat", variable):
                    found[name] = Samples(time, tables.array("glstat", variable) * factor)
        if "total" in found and "external work" in found and "ratio" in found:
            del found["total"]  # the solver's own ratio knows best what it counts
        if "mass" not in found and tables.has_table("matsum") and tables.has("matsum", "mass"):
            # Mass scaling makes the parts' mass grow.
            mass = tables.columns("matsum", "mass").sum(axis=1) * units.mass
            found["mass"] = Samples(tables.times("matsum", units.time), mass)
        return found

    def _variable(self, table: str, name: str, variable: str) -> Samples:
        tables = self._tables
        if not tables.has_table(table):
            have = ", ".join(sorted(tables.tables()))
            raise DataError(f"{self._source}: there is no table `{table}`; there are {have}: request it")
        known: dict[str, int] = {}
        for names in (tables.legend(table), map(str, tables.ids(table))):
            for k, title in enumerate(names):
                known.setdefault(title, k)  # `rcforc` has each contact twice: its first side counts
        k = known[match_one(name, known, "object", f"{self._source}: {table}")]
        return Samples(tables.times(table, self._units.time), tables.columns(table, variable)[:, k])

    def _node(self, name: str) -> tuple[Any, Any, Any]:
        """Return a node's times, its place at the first instant, and its displacements."""
        moved = [self._variable("nodout", name, f"{axis}_displacement") for axis in AXES]
        place = [self._variable("nodout", name, f"{axis}_coordinate").values[0] for axis in AXES]
        displaced = np.stack([m.values for m in moved], axis=1)
        return moved[0].time, np.array(place) - displaced[0], displaced
