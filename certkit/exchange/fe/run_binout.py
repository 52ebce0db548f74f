"""A run as LS-DYNA binout files: any table's variables by title or id, nodes' distances, and `glstat`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.part_selection import AXES
from certkit.errors import DataError
from certkit.exchange.fe.binout_files import BinoutFiles
from certkit.exchange.fe.binout_tables import BinoutTables
from certkit.exchange.fe.histories import match_one
from certkit.exchange.fe.run_histories import Samples
from certkit.exchange.fe.run_objects import NodePath, RunOfObjects

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

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


class BinoutRun(RunOfObjects):
    """Tables of one or several binouts."""

    kind = "a binout has tables"

    def __init__(self, paths: Sequence[Path], units: Units) -> None:
        """Open the binouts.

        Raises
        ------
        DataError
            Without lasso-python, or for a file that is no binout.
        """
        self.units = units
        self.source = ", ".join(str(path) for path in paths)
        self._opened = BinoutFiles(paths)
        self.files = self._opened.digests
        self._tables = BinoutTables(self._opened, self.source)

    @property
    def remarks(self) -> tuple[str, ...]:
        """What there is to say of the files and of how they were joined."""
        return tuple(self._tables.remarks())

    def close(self) -> None:
        """Forget the copies that were made to read from."""
        self._opened.close()

    def energies(self) -> Mapping[str, Samples]:
        """Return the energies of `glstat`."""
        found: dict[str, Samples] = {}
        tables, units = self._tables, self.units
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

    def variable(self, table: str, name: str, variable: str) -> Samples:
        """Return a variable of one object, by its title or id."""
        tables = self._tables
        if not tables.has_table(table):
            have = ", ".join(sorted(tables.tables()))
            raise DataError(f"{self.source}: there is no table `{table}`; there are {have}: request it")
        known: dict[str, int] = {}
        for names in (tables.legend(table), map(str, tables.ids(table))):
            for k, title in enumerate(names):
                known.setdefault(title, k)  # `rcforc` has each contact twice: its first side counts
        k = known[match_one(name, known, "object", f"{self.source}: {table}")]
        return Samples(tables.times(table, self.units.time), tables.columns(table, variable)[:, k])

    def node(self, name: str) -> NodePath:
        """Return where a node of `nodout` is."""
        moved = [self.variable("nodout", name, f"{axis}_displacement") for axis in AXES]
        first = [self.variable("nodout", name, f"{axis}_coordinate").values[0] for axis in AXES]
        displacement = np.stack([m.values for m in moved], axis=1)
        return NodePath(moved[0].time, np.array(first) - displacement[0], displacement)
