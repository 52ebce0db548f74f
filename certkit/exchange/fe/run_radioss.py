"""A run as OpenRadioss' native time history (`…T01`): any group's variables by title or id, and energies.

The file numbers its variables; the names of most of them stand in the file `…T01_TITLES` beside it. Forces
and moments of contacts, sections and rigid bodies are impulses in the file: their central difference is the
force, as OpenRadioss' own converter takes it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes, require_finite, require_time_axis
from certkit.exchange.fe.fortran_records import FortranRecords
from certkit.exchange.fe.histories import match_one, parse_units
from certkit.exchange.fe.radioss_directory import read_directory, read_instants, require_units
from certkit.exchange.fe.radioss_variables import GLOBALS, GROUP_VARIABLES, KINDS, SPRING_GROUP, is_impulse
from certkit.exchange.fe.run_histories import Samples
from certkit.exchange.fe.run_objects import NodePath, RunOfObjects

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

    Values = NDArray[np.float64]

_STRANDS = "100"
"""Kind of strands in the file of titles; the history counts them as springs."""


class RadiossRun(RunOfObjects):
    """Groups and global variables of one native file."""

    kind = "a native file has groups"

    def __init__(self, path: Path, units: str) -> None:
        """Read the file, and the names of its variables where they stand beside it.

        Raises
        ------
        DataError
            For anything that is no whole, self-consistent file of this kind, or one of other units.
        """
        content, digest = read_bytes(path)
        self.units, self.source = parse_units(units), str(path)
        self.files = self._digests = {str(path): digest}
        records = FortranRecords(content, self.source)
        self._directory = read_directory(records, self.source)
        remark = require_units(self._directory, self.units, units, self.source)
        self._remark = remark
        time, data = read_instants(records, self._directory, self.source)
        require_time_axis(time, self.source)
        self._time = time * self.units.time
        self._globals = data[:, : len(self._directory.globals_)]
        first = len(self._directory.globals_) + sum(len(v) for _, v in self._directory.parts)
        self._groups = data[:, first + self._directory.subset_width :]
        self._columns = self._named(self._titles(path))

    @property
    def remarks(self) -> tuple[str, ...]:
        """What there is to say of the units that the file names."""
        return () if self._remark is None else (self._remark,)

    def energies(self) -> Mapping[str, Samples]:
        """Return the global energies; the internal energy holds that of the springs."""
        told = {
            GLOBALS[number - 1]: self._globals[:, k]
            for k, number in enumerate(self._directory.globals_)
            if number <= len(GLOBALS)
        }
        found: dict[str, Samples] = {
            name: Samples(self._time, told[name] * self.units.energy)
            for name in ("kinetic", "internal", "hourglass", "contact", "external work")
            if name in told
        }
        if {"kinetic", "internal"} <= told.keys():
            total = told["kinetic"] + told["internal"] + told.get("rotation", 0.0)
            found["total"] = Samples(self._time, total * self.units.energy)
        for name in ("mass", "added mass"):
            if name in told:
                found[name] = Samples(self._time, told[name] * self.units.mass)
        return found

    def variable(self, table: str, name: str, variable: str) -> Samples:
        """Return a variable of one object of a kind of group, by its title or id; impulses as forces."""
        kind = KINDS[match_one(table, KINDS, "kind of group", self.source)]
        objects = self._columns.get(kind, {})
        held = objects[match_one(name, objects, table, self.source)]
        column = held[match_one(variable, held, "variable", f"{self.source}: {table} `{name}`")]
        values = self._groups[:, column]
        require_finite(values, f"{name} {variable}", self.source)
        if is_impulse(kind, variable):
            values = rate_of(values, self._time / self.units.time)
        return Samples(self._time, values)

    def node(self, name: str) -> NodePath:
        """Return where a node is."""
        displacement = np.stack([self.variable("node", name, f"D{axis}").values for axis in "XYZ"], axis=1)
        first = np.array([self.variable("node", name, axis).values[0] for axis in "XYZ"])
        return NodePath(self._time, first - displacement[0], displacement)

    def _named(self, titles: list[str]) -> dict[int, dict[str, dict[str, int]]]:
        """Return the column of each variable by kind, object (title and id) and the variable's name."""
        found: dict[int, dict[str, dict[str, int]]] = {}
        column = 0
        for group in self._directory.groups:
            known = dict(enumerate(GROUP_VARIABLES.get(group.kind, ()), 1))
            for title, number in zip(group.names, group.ids, strict=True):
                names = {}
                for variable in group.variables:
                    told = titles[column] if titles else known.get(variable, f"var {variable}")
                    names[told] = column
                    column += 1
                for key in (title, str(number)):
                    found.setdefault(group.kind, {}).setdefault(key, {}).update(names)
        return found

    def _titles(self, path: Path) -> list[str]:
        """Return the name of each column of the groups; empty where the titles' file is missing."""
        plain = path.with_name(path.name.removesuffix(".gz") + "_TITLES")
        packed = plain.with_name(plain.name + ".gz")
        if not (plain.exists() or packed.exists()):
            return []
        used = plain if plain.exists() else packed
        content, digest = read_bytes(used)
        self._digests[str(used)] = digest
        lines = content.decode("latin-1").splitlines()
        names = [line.strip() for line in lines[1::2]]
        wanted = [
            group.kind for group in self._directory.groups for _ in group.names for _ in group.variables
        ]
        if len(names) != len(wanted):
            raise DataError(
                f"{used}: names {len(names)} variables, the history has {len(wanted)}; copy both "
                "files of one run"
            )
        for number, (told, kind) in enumerate(zip(lines[::2], wanted, strict=True)):
            if told.strip() != str(kind) and (told.strip(), kind) != (_STRANDS, SPRING_GROUP):
                raise DataError(
                    f"{used}:{2 * number + 1}: kind {told.strip()} where the history has kind {kind}; "
                    "copy both files of one run"
                )
        return names


def rate_of(impulse: Values, time: Values) -> Values:
    """Return (J[i+1] − J[i−1]) / (t[i+1] − t[i−1]), one-sided at both ends: N, of N·s and s, shape (n,)."""
    rate = np.empty_like(impulse)
    rate[1:-1] = (impulse[2:] - impulse[:-2]) / (time[2:] - time[:-2])
    rate[0] = (impulse[1] - impulse[0]) / (time[1] - time[0])
    rate[-1] = (impulse[-1] - impulse[-2]) / (time[-1] - time[-2])
    return rate
