"""Tidy CSV files: a column a quantity, its unit at the end of its name, and a mapping of what is what."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.histories import ContactHistory, PartHistories, PartHistory, SpringHistory, match_one
from certkit.exchange.fe.integral import running_integral
from certkit.exchange.fe.numeric_table import read_table
from certkit.exchange.fe.run_tidy import TidyRun
from certkit.exchange.fe.unit_suffixes import SUFFIXES, time_axis

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import ContactColumns, HistoryFiles, PartColumns
    from certkit.definitions.virtual_test import FiniteElements

    Values = NDArray[np.float64]

T = TypeVar("T")

LEG_CHANNELS = {
    **{name: (f"{name}_Nm", "moment") for name in ("F1", "F2", "F3", "T1", "T2", "T3", "T4")},
    **{name: (f"{name}_elong_mm", "length") for name in ("MCL", "ACL", "PCL")},
}
"""Channel of the leg → its column, where a file has it, and the column's dimension."""


USUAL_FILES = ("*.csv", "*.csv.gz")


def holds(_: bytes) -> bool:
    """Take whatever no other format is for a table, and say what is wrong with it."""
    return True


def open_run(paths: Sequence[Path], layout: FiniteElements) -> TidyRun:
    """Open a run that is graded."""
    return TidyRun(paths, layout)


def read(paths: Sequence[Path], section: HistoryFiles) -> PartHistories:
    """Read tidy CSV files that share one time axis.

    Parameters
    ----------
    paths : sequence of Path
    section : HistoryFiles
        The case's section that names the columns.

    Raises
    ------
    DataError
        For damaged tables, time axes that differ, columns that are missing or whose unit does not fit.
    """
    columns = _Columns(paths, section.time)
    parts = {
        name: PartHistory(
            mass=None if spec.mass is None else float(spec.mass),
            momentum=columns.get(spec.momentum, star, "momentum"),
            displacement=columns.get(spec.displacement, star, "length"),
            front=columns.get(spec.front, star, "length"),
            velocity=columns.get(spec.velocity, star, "speed"),
        )
        for name, spec, star in columns.expanded(section.parts, _key_of_part)
    }
    contacts = {
        name: _contact(spec, star, columns)
        for name, spec, star in columns.expanded(section.contacts, lambda c: c.impulse or c.force or "")
    }
    springs = {
        name: SpringHistory(
            columns.require(spec.force, star, "force"), columns.get(spec.shortening, star, "length")
        )
        for name, spec, star in columns.expanded(section.springs, lambda c: c.force)
    }
    nodes = {name: columns.require(column, "", "length") for name, column in section.nodes.items()}
    leg = {
        name: columns.require(column, "", dimension)
        for name, (column, dimension) in LEG_CHANNELS.items()
        if columns.has(column)
    }
    return PartHistories(
        time=columns.time,
        leg=leg,
        parts=parts,
        nodes=nodes,
        contacts=contacts,
        springs=springs,
        notes=_notes(section),
        source=columns.source,
        files=columns.files,
    )


def _key_of_part(spec: PartColumns) -> str:
    return spec.momentum or spec.velocity or spec.displacement or spec.front or ""


def _contact(spec: ContactColumns, star: str, columns: _Columns) -> ContactHistory:
    force = columns.get(spec.force, star, "force")
    if spec.impulse is not None or force is None:
        return ContactHistory(columns.require(spec.impulse or spec.force or "", star, "momentum"), force)
    return ContactHistory(running_integral(force, columns.time), force)


def _notes(section: HistoryFiles) -> tuple[str, ...]:
    integrated = [name for name, spec in section.contacts.items() if spec.impulse is None]
    return (f"impulses are integrals of forces: {', '.join(integrated)}",) if integrated else ()


class _Columns:
    """All columns of all files, found by name, with their units."""

    def __init__(self, paths: Sequence[Path], time: str) -> None:
        self._tables = [read_table(path) for path in paths]
        self.source = ", ".join(t.source for t in self._tables)
        self.files = {t.source: t.digest for t in self._tables}
        self._columns: dict[str, tuple[Values, str]] = {}
        for table in self._tables:
            axis = time_axis(table, time)
            if table is self._tables[0]:
                self.time = axis
            elif axis.shape != self.time.shape or not np.allclose(axis, self.time, rtol=0, atol=1e-9):
                raise DataError(
                    f"{table.source}: its times differ from those of {self._tables[0].source}; "
                    "both must be of one run and uncut"
                )
            for name, values in table.columns.items():
                self._columns.setdefault(name, (values, table.source))

    def has(self, name: str) -> bool:
        """Tell whether a file has the column."""
        return name in self._columns

    def require(self, template: str, star: str, dimension: str) -> Values:
        """Return the column in SI, shape (n,); `*` in the template is replaced by `star`."""
        name = template.replace("*", star)
        if name not in self._columns:
            match_one(name, self._columns, "column", self.source)
        values, source = self._columns[name]
        suffix = name.rsplit("_", 1)[-1]
        if suffix not in SUFFIXES or SUFFIXES[suffix][0] != dimension:
            units = ", ".join(f"_{u}" for u, (d, _) in SUFFIXES.items() if d == dimension)
            raise DataError(
                f"{source}: column `{name}` should be a {dimension}; its name must end in {units}"
            )
        return values * SUFFIXES[suffix][1]

    def get(self, template: str | None, star: str, dimension: str) -> Values | None:
        """Return the column in SI, shape (n,); None where there is none for this part, or none is named."""
        if template is None or ("*" in template and template.replace("*", star) not in self._columns):
            return None
        return self.require(template, star, dimension)

    def expanded(self, mapping: Mapping[str, T], key: Callable[[T], str]) -> Iterator[tuple[str, T, str]]:
        """Yield (name, spec, star) with each `*` entry once for every column that its key column matches."""
        for name, spec in mapping.items():
            template = key(spec)
            if "*" not in name:
                yield name, spec, ""
                continue
            before, _, after = template.partition("*")
            for column in self._columns:
                if len(column) > len(template) - 1 and column.startswith(before) and column.endswith(after):
                    star = column[len(before) : len(column) - len(after)]
                    full = name.replace("*", star)
                    if full not in mapping:
                        yield full, spec, star
