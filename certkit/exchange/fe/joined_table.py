"""One table of a run's binout files, whichever way the solver spread it over them.

A massively parallel run writes tables, or the objects of one, into `binout0000`, `binout0001` and so on; one
that was started again goes on in a new file. Objects of other files stand beside each other. One object in
several files is told by one after the other: from where the later begins it counts, because a restart goes
on from there and leaves what the earlier had written beyond.
"""

from __future__ import annotations

from collections import Counter
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct

from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    Values = NDArray[np.float64]
    Key = tuple[int, int]

HOLE = 5.0
"""Steps that may be missing between two files."""

UNLIKE = 5.0
"""Per cent of the largest value by which two files may differ where their times overlap."""


class TableFile(Struct, frozen=True):
    """A file's share of a table: its times, and its objects as (id, how often it has stood there before)."""

    name: str
    reader: Any  # lasso ships no types
    time: Values
    keys: tuple[Key, ...]

    @property
    def span(self) -> str:
        """Return its times in words."""
        return f"{self.name} ({self.time[0]:g} to {self.time[-1]:g})"


class JoinedTable:
    """A table of one or several opened files.

    Parameters
    ----------
    files : sequence of (str, reader)
        Each file's name and lasso's `Binout`.
    path : tuple of str
        Such as ("rcforc",) or ("elout", "beam").
    source : str
        For messages.
    """

    def __init__(self, files: Sequence[tuple[str, Any]], path: tuple[str, ...], source: str) -> None:
        """Put the files in the order of time and find out which tells what.

        Raises
        ------
        DataError
            For holes between files, a file inside another's time, and objects that have other instants.
        """
        self._path, self._source = path, f"{source}: {'/'.join(path)}"
        parts = [_part(name, reader, path, self._source) for name, reader in files]
        self._files = sorted(parts, key=lambda part: (float(part.time[0]), part.name))
        self.keys = list(dict.fromkeys(key for part in parts for key in part.keys))
        self._tellers = {key: [part for part in self._files if key in part.keys] for key in self.keys}
        self.remarks: dict[str, float] = {}
        """Pairs of files that overlap → by how much they differ, per cent of the largest value."""
        axes: dict[tuple[str, ...], Values] = {}
        for tellers in self._tellers.values():
            names = tuple(part.name for part in tellers)
            if names not in axes:
                self._require_sequence(tellers)
                axes[names] = np.concatenate([part.time[rows] for part, rows in _pieces(tellers)])
        self.time = max(axes.values(), key=len)
        for names, axis in axes.items():
            if axis.shape != self.time.shape or not np.allclose(axis, self.time, rtol=1e-6, atol=0):
                key = next(
                    k for k, tellers in self._tellers.items() if tuple(p.name for p in tellers) == names
                )
                raise DataError(
                    f"{self._source}: object {key[0]} has other instants ({axis[0]:g} to {axis[-1]:g} in "
                    f"{', '.join(names)}) than others ({self.time[0]:g} to {self.time[-1]:g}); name all "
                    "files of one run"
                )

    @property
    def ids(self) -> list[int]:
        """Return the ids of the objects, one a column."""
        return [number for number, _ in self.keys]

    @cached_property
    def variables(self) -> set[str]:
        """What any of the files has."""
        return {str(name) for part in self._files for name in part.reader.read(*self._path)}

    def titles(self, widths: Sequence[int]) -> dict[int, str]:
        """Return the titles by id; `widths` are the characters that a title may have."""
        found: dict[int, str] = {}
        for part in self._files:
            if not {"legend", "legend_ids"} <= set(part.reader.read(*self._path)):
                continue
            text = str(part.reader.read(*self._path, "legend"))
            titled = np.atleast_1d(np.asarray(part.reader.read(*self._path, "legend_ids"))).astype(int)
            for width in widths:
                if titled.size and len(text) == width * titled.size:
                    for k, number in enumerate(titled):
                        found.setdefault(int(number), text[width * k : width * (k + 1)].strip())
        return {number: title for number, title in found.items() if title}

    def columns(self, variable: str) -> Values:
        """Return a variable, shape (instants, objects).

        Raises
        ------
        DataError
            When a file lacks it, has not one row an instant, or says something else where another overlaps.
        """
        held = {part.name: self._values(part, variable) for part in self._files}
        largest = max((float(np.abs(values).max()) for values in held.values() if values.size), default=0.0)
        found = np.empty((self.time.size, len(self.keys)))
        for column, (key, tellers) in enumerate(self._tellers.items()):
            pieces = []
            for part, rows in _pieces(tellers):
                pieces.append(held[part.name][rows, part.keys.index(key)])
            found[:, column] = np.concatenate(pieces)
            for earlier, later in pairwise(tellers):
                self._compare(
                    earlier, later, [held[p.name][:, p.keys.index(key)] for p in (earlier, later)], largest
                )
        return found

    def _values(self, part: TableFile, variable: str) -> Values:
        if variable not in part.reader.read(*self._path):
            raise DataError(
                f"{self._source} has no `{variable}` in {part.name}; is the file whole? Copy it again, or "
                "request it from the solver"
            )
        try:
            values = np.asarray(part.reader.read(*self._path, variable), dtype=np.float64)
        except Exception as error:  # noqa: BLE001  # whatever lasso raises, the file is what is wrong
            raise DataError(
                f"{self._source}: `{variable}` of {part.name} cannot be read ({error}); copy the file again"
            ) from None
        values = values[:, None] if values.ndim == 1 else values
        if values.shape != (part.time.size, len(part.keys)):
            raise DataError(
                f"{self._source}: `{variable}` of {part.name} holds {' × '.join(map(str, values.shape))} "
                f"values where {part.time.size} instants × {len(part.keys)} objects belong; the file was "
                "cut: copy it again"
            )
        return values

    def _require_sequence(self, tellers: Sequence[TableFile]) -> None:
        for earlier, later in pairwise(tellers):
            step = float(np.median(np.diff(earlier.time))) if earlier.time.size > 1 else 0.0
            if later.time[-1] < earlier.time[-1] - 0.5 * step:
                raise DataError(
                    f"{self._source}: {later.span} lies inside {earlier.span}; name files of one run"
                )
            gap = float(later.time[0] - earlier.time[-1])
            if step > 0 and gap > HOLE * step:
                raise DataError(
                    f"{self._source}: between {earlier.span} and {later.span} a time of {gap:g} is missing; "
                    "is there a file between them? Name it too"
                )

    def _compare(
        self, earlier: TableFile, later: TableFile, values: Sequence[Values], largest: float
    ) -> None:
        both = earlier.time >= later.time[0]
        if not np.any(both):
            return
        again = np.interp(earlier.time[both], later.time, values[1])
        off = 100.0 * float(np.abs(again - values[0][both]).max()) / largest if largest > 0 else 0.0
        pair = f"{earlier.span} and {later.span}"
        self.remarks[pair] = max(self.remarks.get(pair, 0.0), off)
        if off > UNLIKE:
            raise DataError(
                f"{self._source}: {pair} overlap and differ by {off:.0f} % of the largest value; name "
                "files of one run"
            )


def _part(name: str, reader: Any, path: tuple[str, ...], source: str) -> TableFile:  # noqa: ANN401
    variables = reader.read(*path)
    if "time" not in variables:
        raise DataError(f"{source} of {name} has no time; the file was cut: copy it again")
    time = np.atleast_1d(np.asarray(reader.read(*path, "time"), dtype=np.float64))
    ids = (
        np.atleast_1d(np.asarray(reader.read(*path, "ids"))).astype(int).ravel()
        if "ids" in variables
        else [0]
    )
    seen: Counter[int] = Counter()
    keys = []
    for number in map(int, ids):
        keys.append((number, seen[number]))
        seen[number] += 1
    return TableFile(name, reader, time, tuple(keys))


def _pieces(tellers: Sequence[TableFile]) -> list[tuple[TableFile, NDArray[np.bool_]]]:
    """Return which rows of each file count: those before the next file begins."""
    ends = [float(part.time[0]) for part in tellers[1:]] + [np.inf]
    return [(part, part.time < end) for part, end in zip(tellers, ends, strict=True)]
