"""A run as tidy tables: a column a quantity, its unit at the end of its name."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.definitions.units import parse_quantity
from certkit.errors import DataError
from certkit.exchange.fe.histories import match_one
from certkit.exchange.fe.numeric_table import read_table
from certkit.exchange.fe.run_histories import RunFiles, Samples
from certkit.exchange.fe.unit_suffixes import SUFFIXES, time_axis

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from certkit.definitions.virtual_test import FiniteElements, History


class TidyRun(RunFiles):
    """Columns of one or several tables; each table has its own time axis."""

    def __init__(self, paths: Sequence[Path], layout: FiniteElements) -> None:
        """Read the tables.

        Raises
        ------
        DataError
            For a damaged table, or one without the time column.
        """
        self._layout = layout
        self._columns: dict[str, Samples] = {}
        self._sources: dict[str, str] = {}
        self.files: dict[str, str] = {}
        for path in paths:
            table = read_table(path)
            time = time_axis(table, layout.time)
            self.files[str(path)] = table.digest
            for name, values in table.columns.items():
                if name != layout.time and name not in self._columns:
                    self._columns[name] = Samples(time, values)
                    self._sources[name] = table.source

    def history(self, asked: History, dimension: str) -> Samples:
        """Return a column in SI units."""
        if asked.column is None:
            raise DataError("a tidy table has columns; name the channel's `column` in the mapping")
        return self._column(asked.column, dimension, asked.unit)

    def energies(self) -> Mapping[str, Samples]:
        """Return the columns that the mapping calls energies, SI."""
        told = self._layout.energies
        found: dict[str, Samples] = {}
        for name, columns in (
            ("kinetic", told.kinetic),
            ("internal", told.internal),
            ("hourglass", told.hourglass),
            ("contact", told.contact),
            ("external work", told.external_work),
            ("total", told.total),
        ):
            if columns is not None:
                parts = [self._column(column, "energy", None) for column in columns]
                values = np.sum([part.at(parts[0].time) for part in parts], axis=0)
                found[name] = Samples(parts[0].time, values)
        if told.ratio is not None:
            found["ratio"] = self._raw(told.ratio)
        if told.mass is not None:
            found["mass"] = self._raw(told.mass)
        return found

    def _raw(self, name: str) -> Samples:
        found = self._columns[match_one(name, self._columns, "column", ", ".join(self.files))]
        return Samples(found.time, found.values)

    def _column(self, name: str, dimension: str, unit: str | None) -> Samples:
        found = self._columns[match_one(name, self._columns, "column", ", ".join(self.files))]
        return Samples(found.time, found.values * self._factor(name, dimension, unit))

    def _factor(self, name: str, dimension: str, unit: str | None) -> float:
        if unit is not None:
            try:
                return parse_quantity(f"1 {unit}", dimension)
            except ValueError as error:
                raise DataError(
                    f"{self._sources[name]}: column `{name}`: {error}; correct the mapping"
                ) from None
        suffix = name.rsplit("_", 1)[-1]
        if SUFFIXES.get(suffix, ("",))[0] != dimension:
            raise DataError(
                f"{self._sources[name]}: column `{name}` should be a {dimension}, which its name does not "
                "end in; give its `unit` in the mapping"
            )
        return SUFFIXES[suffix][1]
