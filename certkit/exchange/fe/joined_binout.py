"""Several binout files of one run as one: what MPP wrote table by table, or a restart went on with.

A massively parallel run spreads its tables, or the objects of one, over `binout0000`, `binout0001` and so on;
a run that was started again goes on in a new file. Files that hold the same objects of a table
follow each other in time, where they overlap the earlier one counts; other objects stand beside them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from certkit.errors import DataError

if TYPE_CHECKING:
    from collections.abc import Sequence

_ONCE = ("ids", "legend", "title", "version", "date", "revision", "side")
"""Words in the names of what does not change with time; it is taken from the first file."""


class JoinedBinout:
    """Opened binout files that are read as one; `read` is lasso-python's.

    Parameters
    ----------
    readers : sequence
        One or more of lasso's `Binout`.
    source : str
        For messages.
    """

    def __init__(self, readers: Sequence[Any], source: str) -> None:
        self._readers, self._source = readers, source

    def read(self, *names: str) -> Any:  # noqa: ANN401  # names of tables, of variables, or values
        """Return the names of all tables, of a table's variables, or a variable's values.

        Raises
        ------
        DataError
            When objects of one table were recorded at other instants.
        """
        if not names:
            return sorted({table for reader in self._readers for table in reader.read()})
        holders = [reader for reader in self._readers if names[0] in reader.read()]
        if len(holders) < 2 or len(names) == 1:
            return holders[0].read(*names) if holders else self._readers[0].read(*names)
        objects = _by_objects(holders, names[0])
        found = [_over_time(group, names) for group in objects]
        if len(found) == 1 or names[-1] in {"time", "cycle", *_ONCE} - {"ids", "legend"}:
            return found[0]
        if all(isinstance(each, str) for each in found):
            return "".join(found)
        values = [np.asarray(each) for each in found]
        if any(word in names[-1] for word in _ONCE):
            return np.concatenate([np.atleast_1d(each) for each in values])
        columns = [each[:, None] if each.ndim == 1 else each for each in values]
        if len({each.shape[0] for each in columns}) > 1:
            raise DataError(
                f"{self._source}: {names[0]} has other instants in each file; name all files of the run"
            )
        return np.concatenate(columns, axis=1)


def _by_objects(holders: Sequence[Any], table: str) -> list[list[Any]]:
    """Put files together that hold the same objects of a table, each set in the order of time."""
    groups: dict[tuple[int, ...], list[Any]] = {}
    for reader in holders:
        has = "ids" in reader.read(table)
        ids = tuple(np.atleast_1d(np.asarray(reader.read(table, "ids"))).astype(int)) if has else ()
        groups.setdefault(ids, []).append(reader)
    return [sorted(group, key=lambda reader: float(_times(reader, table)[0])) for group in groups.values()]


def _times(reader: Any, table: str) -> Any:  # noqa: ANN401  # lasso ships no types
    return np.atleast_1d(np.asarray(reader.read(table, "time"), float))


def _over_time(group: Sequence[Any], names: Sequence[str]) -> Any:  # noqa: ANN401  # values of any kind
    """Return a variable of files that hold the same objects: one after the other, the earlier counts."""
    if len(group) == 1 or any(word in names[-1] for word in _ONCE):
        return group[0].read(*names)
    kept, last = [], -np.inf
    for reader in group:
        times = _times(reader, names[0])
        kept.append(np.asarray(reader.read(*names))[times > last])
        last = max(last, float(times[-1]))
    return np.concatenate(kept)
