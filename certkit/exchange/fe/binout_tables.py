"""Tables of a run's binout files as plain two-dimensional arrays, joined where several files hold one.

What binout files do, and this handles: a table with a single id comes back one-dimensional; every table has
its own time vector; keys come in any order; `rcforc` lists each contact twice, once a side.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.checks import require_finite, require_time_axis
from certkit.exchange.fe.histories import distinct
from certkit.exchange.fe.joined_table import JoinedTable

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from certkit.exchange.fe.binout_files import BinoutFiles

    Values = NDArray[np.float64]

_LEGEND_WIDTHS = (80, 70)


class BinoutTables:
    """Tables by name, such as `secforc` or `elout/beam`."""

    def __init__(self, files: BinoutFiles, source: str) -> None:
        self._files, self._source = files, source
        self._joined: dict[str, JoinedTable] = {}

    @cached_property
    def _names(self) -> list[str]:
        found: dict[str, None] = {}
        for _, reader in self._files.readers:
            for name in sorted(reader.read()):
                entries = reader.read(name)
                inner = [] if "time" in entries else sorted(entries)
                inner = [each for each in inner if "time" in reader.read(name, each)]
                found |= dict.fromkeys([f"{name}/{each}" for each in inner] or [name])
        return list(found)

    def tables(self) -> list[str]:
        """Return the names of all tables; those of `elout` and `rwforc` stand one level down."""
        return list(self._names)

    def has_table(self, table: str) -> bool:
        """Tell whether there is a table of that name."""
        return table in self._names

    def has(self, table: str, name: str) -> bool:
        """Tell whether a table has a variable."""
        return name in self._table(table).variables

    def ids(self, table: str) -> list[int]:
        """Return the ids of a table's objects."""
        return self._table(table).ids

    def array(self, table: str, name: str) -> Values:
        """Return a variable of a table that has one value an instant, shape (n,)."""
        return self.columns(table, name)[:, 0]

    def columns(self, table: str, name: str) -> Values:
        """Return a variable, shape (instants, objects), also where a single id comes back as (n,)."""
        if not self.has(table, name):
            raise DataError(
                f"{self._source}: {table} has no `{name}`; is the file whole? Copy it again, or "
                "request it from the solver"
            )
        values = self._table(table).columns(name)
        require_finite(values.ravel(), f"{table}/{name}", self._source)
        return values

    def legend(self, table: str) -> list[str]:
        """Return the names of a table's objects; ids where the model gives no titles."""
        joined = self._table(table)
        titles = joined.titles(_LEGEND_WIDTHS)
        known = distinct((number, titles.get(number, str(number))) for number in dict.fromkeys(joined.ids))
        return [known[number] for number in joined.ids]

    def times(self, table: str, scale: float, *, until: float | None = None) -> Values:
        """Return a table's own times, shape (n,), s, which must reach `until`, the end of matsum."""
        times = self._table(table).time * scale
        require_time_axis(times, f"{self._source}: {table}")
        if until is not None and times[-1] + 1.01 * float(np.diff(times).max()) < until:
            raise DataError(
                f"{self._source}: {table} ends at {times[-1]:g} s, matsum at {until:g} s; the file was cut "
                "or goes on in another one: name a whole binout"
            )
        return times

    def remarks(self) -> list[str]:
        """Return what there is to say of the files and of how they were joined, as far as they were read."""
        overlaps: dict[str, float] = {}
        for joined in self._joined.values():
            for pair, off in joined.remarks.items():
                overlaps[pair] = max(overlaps.get(pair, 0.0), off)
        return [
            *self._files.remarks,
            *(
                f"{pair} overlap and differ by up to {off:.2g} % of the largest value; the later counts"
                for pair, off in overlaps.items()
            ),
        ]

    def _table(self, table: str) -> JoinedTable:
        if table not in self._joined:
            path = tuple(table.split("/"))
            holders = [
                (name, reader)
                for name, reader in self._files.readers
                if path[0] in reader.read() and (len(path) == 1 or path[1] in reader.read(path[0]))
            ]
            self._joined[table] = JoinedTable(holders, path, self._source)
        return self._joined[table]
