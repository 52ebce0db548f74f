"""OpenRadioss' native time history (`…T01`): big-endian Fortran records.

No library reads it. The layout was worked out from the files themselves and is checked here against itself:
every record's length stands before and after it, and the lengths of the data records must agree with the
directory.

Records: run title with the format code · date · six counts (parts, materials, properties, subsets, groups,
global variables) · global variable numbers · per part a description and its variable numbers · materials ·
properties · subsets with their parts and variables · groups with their objects and variables · then for each
instant: time, global values, part values, subset values, one record for each group; all 32-bit.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes, require_finite, require_time_axis
from certkit.exchange.fe.histories import distinct, parse_units
from certkit.exchange.fe.numeric_table import plain
from certkit.exchange.fe.one_file import one_file
from certkit.exchange.fe.radioss import part_histories
from certkit.exchange.fe.radioss_channels import Channels

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import HistoryFiles
    from certkit.exchange.fe.histories import PartHistories

    Variables = dict[str, NDArray[np.float64]]

GLOBALS: tuple[str, ...] = (
    "internal",
    "kinetic",
    "x momentum",
    "y momentum",
    "z momentum",
    "mass",
    "time step",
    "rotation",
)
GLOBALS += ("external work", "spring", "contact", "hourglass")
_ENERGIES = frozenset(GLOBALS) - {"x momentum", "y momentum", "z momentum", "mass", "time step"}
GLOBALS += ("elastic contact", "frictional contact", "damping contact", "plastic work", "added mass")
_PART_VARIABLES = {
    1: "IE", 2: "KE", 3: "XMOM", 4: "YMOM", 5: "ZMOM", 6: "MASS", 7: "HE", 9: "XCG", 10: "YCG", 11: "ZCG",
    29: "VX", 30: "VY", 31: "VZ",
}  # fmt: skip
NODE_GROUP, CONTACT_GROUP = 0, 101
GROUP_VARIABLES = {
    NODE_GROUP: ("DX", "DY", "DZ", "VX", "VY", "VZ"),
    CONTACT_GROUP: ("FNX", "FNY", "FNZ", "FTX", "FTY", "FTZ"),
}
_TITLE_AT_CODE_40 = range(3000, 3041)
_MOST_OBJECTS = 100_000


@dataclass(frozen=True)
class ObjectGroup:
    """Objects of one kind with their variables, as the directory announces them."""

    kind: int
    names: tuple[str, ...]
    variables: tuple[int, ...]
    ids: tuple[int, ...] = ()


@dataclass(frozen=True)
class HistoryDirectory:
    """What every instant of the file holds, in the order of its records."""

    globals_: tuple[int, ...]
    parts: tuple[tuple[str, tuple[int, ...]], ...]
    subset_width: int
    groups: tuple[ObjectGroup, ...]


class FortranRecords:
    """The file's records one after the other, each checked by the lengths around it."""

    def __init__(self, content: bytes, source: str) -> None:
        self._content, self._source, self._at = content, source, 0

    def __bool__(self) -> bool:
        """Tell whether a record is left."""
        return self._at < len(self._content)

    def next(self) -> bytes:
        """Return the next record without its lengths."""
        at, content = self._at, self._content
        if at + 4 > len(content):
            raise self._cut()
        (length,) = struct.unpack_from(">i", content, at)
        end = at + 4 + length
        if length < 0:
            raise DataError(
                f"{self._source}: byte {at} is no record of a native OpenRadioss time history; copy "
                "it as binary, or name its format"
            )
        if end + 4 > len(content):
            raise self._cut()
        if struct.unpack_from(">i", content, end)[0] != length:
            raise DataError(
                f"{self._source}: the record at byte {at} has two different lengths; is this a native "
                "OpenRadioss "
                "time history (…T01), copied as binary?"
            )
        self._at = end + 4
        return content[at + 4 : end]

    def integers(self) -> tuple[int, ...]:
        """Return the next record as whole numbers."""
        record = self.next()
        if len(record) % 4:
            raise DataError(
                f"{self._source}: a directory record before byte {self._at} is damaged; copy it again"
            )
        return struct.unpack(f">{len(record) // 4}i", record)

    def _cut(self) -> DataError:
        return DataError(
            f"{self._source}: the file ends inside the record at byte {self._at}; it was cut: copy it again"
        )


def read(paths: Sequence[Path], section: HistoryFiles) -> PartHistories:
    """Read the time history of a case."""
    channels = read_native(one_file(paths, section))
    return part_histories(channels, parse_units(section.units), section.rigid_bodies)


def read_native(path: Path) -> Channels:
    """Read a native OpenRadioss time history (`…T01` or `…T01.gz`).

    Raises
    ------
    DataError
        For anything that is no whole, self-consistent file of this kind.
    """
    content, digest = read_bytes(path)
    source = str(path)
    records = FortranRecords(content, source)
    try:
        directory = read_directory(records, source)
    except struct.error:
        raise DataError(
            f"{source}: a record of the directory is too short; the file is damaged; copy it again"
        ) from None
    time, data = read_instants(records, directory, source)
    require_time_axis(time, source)
    columns = iter(data.T)
    energies = {
        GLOBALS[number - 1]: values
        for number, values in zip(directory.globals_, columns, strict=False)
        if number <= len(GLOBALS) and GLOBALS[number - 1] in _ENERGIES
    }
    parts = {name: _named(variables, columns, _PART_VARIABLES) for name, variables in directory.parts}
    for _ in range(directory.subset_width):
        next(columns)
    objects: dict[int, dict[str, Variables]] = {NODE_GROUP: {}, CONTACT_GROUP: {}}
    for group in directory.groups:
        names = dict(enumerate(GROUP_VARIABLES.get(group.kind, ()), 1))
        for name in group.names:
            objects.setdefault(group.kind, {})[name] = _named(group.variables, columns, names)
    for kind in (parts, objects[NODE_GROUP], objects[CONTACT_GROUP]):
        for name, known in kind.items():
            for variable, values in known.items():
                require_finite(values, f"{name} {variable}", source)
    return Channels(
        time, energies, parts, objects[CONTACT_GROUP], objects[NODE_GROUP],
        impulses=True, source=source, digest=digest,
    )  # fmt: skip


def _named(
    variables: tuple[int, ...], columns: Iterator[NDArray[np.float64]], names: Mapping[int, str]
) -> Variables:
    """Take one column a variable and keep those that have a name."""
    taken = {number: next(columns) for number in variables}
    return {names[number]: np.ascontiguousarray(v) for number, v in taken.items() if number in names}


def read_directory(records: FortranRecords, source: str) -> HistoryDirectory:
    """Read what stands before the first instant."""
    title = records.next()
    code = struct.unpack_from(">i", title)[0] if len(title) >= 4 else 0
    if code not in _TITLE_AT_CODE_40:
        raise DataError(
            f"{source}: format code {code} is not known (known: {_TITLE_AT_CODE_40.start} to "
            f"{_TITLE_AT_CODE_40.stop - 1}); "
            "convert the file to CSV and read that"
        )
    records.next()  # date and solver
    counts = records.integers()
    if len(counts) != 6 or any(not 0 <= n <= _MOST_OBJECTS for n in counts):
        raise DataError(
            f"{source}: the directory's counts {counts[:6]} make no sense; the file is damaged: copy "
            "it again; copy it again"
        )
    n_parts, n_materials, n_properties, n_subsets, n_groups, n_globals = counts
    globals_ = records.integers() if n_globals else ()
    titles, parts = [], []
    for _ in range(n_parts):
        description = records.next()
        width = _integer_at(description, -4, source)
        titles.append(_titled(description))
        parts.append(records.integers() if width else ())
        _agree(len(parts[-1]), width, f"part `{titles[-1][1]}`", source)
    for _ in range(n_materials + n_properties):
        records.next()
    subset_width = 0
    for _ in range(n_subsets):
        description = records.next()
        _, _, n_children, n_members, width = struct.unpack_from(">5i", description)
        for count in (n_children, n_members, width):
            if count:
                records.integers()
        subset_width += width
    groups = []
    for _ in range(n_groups):
        _, kind, _, n_objects, width = struct.unpack_from(">5i", records.next())
        objects = tuple(_titled(records.next()) for _ in range(n_objects))
        variables = records.integers() if width else ()
        _agree(len(variables), width, "a group of objects", source)
        groups.append((kind, objects, variables))
    _agree(len(globals_), n_globals, "the global variables", source)
    names = distinct(titles)
    if len(names) < len(titles):
        raise DataError(f"{source}: two parts have one id; the file is damaged: write it again")
    return HistoryDirectory(
        globals_,
        tuple((names[number], variables) for (number, _), variables in zip(titles, parts, strict=True)),
        subset_width,
        tuple(_named_groups(groups)),
    )


def _named_groups(
    groups: list[tuple[int, tuple[tuple[int, str], ...], tuple[int, ...]]],
) -> Iterator[ObjectGroup]:
    """Name the objects of groups; one title of several nodes or contacts gets their ids."""
    for kind, objects, variables in groups:
        known = distinct(each for other, listed, _ in groups if other == kind for each in listed)
        ids = tuple(number for number, _ in objects)
        yield ObjectGroup(kind, tuple(known[number] for number in ids), variables, ids)


def read_instants(
    records: FortranRecords, directory: HistoryDirectory, source: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read time and all values; every instant must have the records that the directory announces."""
    widths = [1, len(directory.globals_), sum(len(v) for _, v in directory.parts), directory.subset_width]
    widths += [len(g.names) * len(g.variables) for g in directory.groups]
    widths = [w for w in widths if w]
    rows: list[bytes] = []
    while records:
        blocks = [records.next() for _ in widths]
        for block, width in zip(blocks, widths, strict=True):
            if len(block) != 4 * width:
                raise DataError(
                    f"{source}: instant {len(rows) + 1} holds {len(block) // 4} values where the "
                    f"directory announces {width}"
                    "; the file was cut or changed: copy it again"
                )
        rows.append(b"".join(blocks))
    if not rows:
        raise DataError(
            f"{source}: the file has a directory but no instants; the run wrote no history: run it again"
        )
    data = np.frombuffer(b"".join(rows), ">f4").reshape(len(rows), -1).astype(np.float64)
    return data[:, 0], data[:, 1:]


def _titled(description: bytes) -> tuple[int, str]:
    """Return the id and the title of a part, node or contact."""
    return struct.unpack_from(">i", description)[0], plain(description[4:44].decode("latin-1")).strip()


def _integer_at(record: bytes, at: int, source: str) -> int:
    if len(record) < 44:
        raise DataError(f"{source}: a part's description is too short; the file is damaged; copy it again")
    return int(struct.unpack_from(">i", record, len(record) + at)[0])


def _agree(found: int, announced: int, what: str, source: str) -> None:
    if found != announced:
        raise DataError(
            f"{source}: {what} announces {announced} variables and lists {found}; the file is "
            "damaged: copy it again"
        )
