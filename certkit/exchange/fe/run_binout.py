"""A run as LS-DYNA binout files: any table's variables by title or id, nodes' distances, and `glstat`.

Parallel LS-DYNA writes several binouts, each with some tables or with some objects of a table: an object is
looked for in all of them.
"""

from __future__ import annotations

import tempfile
from glob import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes
from certkit.exchange.fe.histories import match_one
from certkit.exchange.fe.readers.ls_dyna_binout import BinoutTables, is_lsda, open_binout
from certkit.exchange.fe.run_histories import Samples, combined, factor_of, growth_of_distance

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

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
        self.files: dict[str, str] = {}
        self._tables: list[BinoutTables] = []
        self._folder = tempfile.TemporaryDirectory(prefix="certkit-")
        self._source = ", ".join(str(path) for path in paths)
        for number, path in enumerate(paths):
            content, digest = read_bytes(path)
            if not is_lsda(content):
                raise DataError(
                    f"{path}: no LSDA container, which starts with its header length 8; name the binout"
                )
            rest = sorted(path.parent.glob(f"{escape(path.name)}%[0-9]*")) if path.suffix != ".gz" else []
            self.files |= {str(path): digest, **{str(part): read_bytes(part)[1] for part in rest}}
            place = Path(self._folder.name) / str(number)
            place.mkdir()
            reader = open_binout(path, content, rest, place, str(path))
            self._tables.append(BinoutTables(reader, str(path)))

    def close(self) -> None:
        """Forget the copies that were made to read from."""
        self._folder.cleanup()

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
        for tables in self._with("glstat"):
            time = tables.times("glstat", self._units.time)
            for name, variable in ENERGIES.items():
                if tables.has("glstat", variable):
                    values = tables.array("glstat", variable) * self._units.energy
                    found.setdefault(name, Samples(time, values))
            if tables.has("glstat", "energy_ratio"):
                found.setdefault("ratio", Samples(time, tables.array("glstat", "energy_ratio")))
            for name in ("added_mass", "mass"):
                if tables.has("glstat", name):
                    values = tables.array("glstat", name) * self._units.mass
                    found.setdefault(name.replace("_", " "), Samples(time, values))
        if "total" in found and "external work" in found and "ratio" in found:
            del found["total"]  # the solver's own ratio knows best what it counts
        found |= self._masses() if "mass" not in found else {}
        return found

    def _masses(self) -> dict[str, Samples]:
        """Return the mass of all parts in `matsum`, which mass scaling makes grow."""
        parts: list[Samples] = []
        for tables in self._with("matsum"):
            if tables.has("matsum", "mass"):
                time = tables.times("matsum", self._units.time)
                mass = tables.columns("matsum", "mass").sum(axis=1) * self._units.mass
                parts.append(Samples(time, mass))
        if not parts:
            return {}
        time = parts[0].time
        return {"mass": Samples(time, np.sum([p.at(time) for p in parts], axis=0))}

    def _with(self, table: str) -> Iterator[BinoutTables]:
        return (tables for tables in self._tables if tables.has_table(table))

    def _variable(self, table: str, name: str, variable: str) -> Samples:
        known: dict[str, tuple[BinoutTables, int]] = {}
        for tables in self._with(table):
            count = np.atleast_1d(tables.array(table, "ids")).size
            for k, title in enumerate(tables.legend(table, count)):
                known.setdefault(title, (tables, k))  # `rcforc` has each contact twice: its first side counts
            for k, i in enumerate(tables.ids(table)):
                known.setdefault(str(i), (tables, k))
        if not known:
            have = ", ".join(sorted({each for tables in self._tables for each in tables.tables()}))
            raise DataError(f"{self._source}: there is no table `{table}`; there are {have}: request it")
        tables, k = known[match_one(name, known, "object", f"{self._source}: {table}")]
        values = tables.columns(table, variable)[:, k]
        return Samples(tables.times(table, self._units.time), values)

    def _node(self, name: str) -> tuple[Any, Any, Any]:
        """Return a node's times, its place at the first instant, and its displacements."""
        moved = [self._variable("nodout", name, f"{axis}_displacement") for axis in AXES]
        place = [self._variable("nodout", name, f"{axis}_coordinate").values[0] for axis in AXES]
        displaced = np.stack([m.values for m in moved], axis=1)
        return moved[0].time, np.array(place) - displaced[0], displaced
