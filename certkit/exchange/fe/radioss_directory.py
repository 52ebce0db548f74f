"""OpenRadioss' native time history (`…T01`): its head, which says what every instant holds, and the instants.

No library reads it. The layout is checked against itself: every record's length stands before and after it,
and the lengths of the data records must agree with the directory.

Records: run title with the format code · date · from code 3050 on a count and that many further records, the
length of titles and the units (kg, m and s in one unit of mass, length and time) · six counts (parts,
materials, properties, subsets, groups, global variables) · global variable numbers · per part a description
and its variable numbers · materials · properties · subsets with their parts and variables · groups with their
objects and variables · then for each instant: time, global values, part values, subset values, one record for
each group that holds something; all 32-bit. Titles have 40 characters up to code 3040, 80 from 3041 and 100
from 4021 on, where the file does not say another length.
"""

from __future__ import annotations

import math
import struct
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from certkit.errors import DataError
from certkit.exchange.fe.histories import distinct
from certkit.exchange.fe.numeric_table import plain

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from certkit.exchange.fe.fortran_records import FortranRecords
    from certkit.exchange.fe.histories import Units

TITLES = ((range(3000, 3041), 40), (range(3041, 3050), 80), (range(3050, 4021), 80), (range(4021, 4100), 100))
"""Format codes that are known → characters of a title."""

FURTHER_RECORDS = 3050
"""First code whose files may tell the length of titles and the units."""

_MOST_OBJECTS = 100_000
_COUNTS = 6
_TITLE, _UNITS = 4, 12
"""Bytes of the further records."""

_NEAR = 1e-5
"""Share by which a 32-bit factor may differ from the unit's."""


class ObjectGroup(Struct, frozen=True):
    """Objects of one kind with their variables, as the directory announces them."""

    kind: int
    names: tuple[str, ...]
    variables: tuple[int, ...]
    ids: tuple[int, ...] = ()


class HistoryDirectory(Struct, frozen=True):
    """What every instant of the file holds, in the order of its records.

    `factors` are the file's own units of mass, length and time in kg, m and s; None where it has none.
    """

    globals_: tuple[int, ...]
    parts: tuple[tuple[str, tuple[int, ...]], ...]
    subset_width: int
    groups: tuple[ObjectGroup, ...]
    factors: tuple[float, float, float] | None = None
    part_ids: tuple[int, ...] = ()


def read_directory(records: FortranRecords, source: str) -> HistoryDirectory:
    """Read what stands before the first instant.

    Raises
    ------
    DataError
        For a format code that is not known, and for records that contradict each other.
    """
    try:
        return _read_directory(records, source)
    except struct.error:
        raise DataError(
            f"{source}: a record of the directory is too short; the file is damaged; copy it again"
        ) from None


def require_units(directory: HistoryDirectory, units: Units, words: str, source: str) -> str | None:
    """Hold the file's own units against those that somebody gave.

    Returns
    -------
    str or None
        A remark where the file's factors are all 1, as of a model that states no units.

    Raises
    ------
    DataError
        When the file says other units.
    """
    told = directory.factors
    if told is None:
        return None
    asked = (units.mass, units.length, units.time)
    if all(math.isclose(a, b, rel_tol=_NEAR) for a, b in zip(told, asked, strict=True)):
        return None
    if all(math.isclose(factor, 1.0, rel_tol=_NEAR) for factor in told):
        return f"the file's unit factors are all 1, as where a model states no units; `{words}` is taken"
    given = ", ".join(f"{factor:.6g} {unit}" for factor, unit in zip(told, ("kg", "m", "s"), strict=True))
    raise DataError(
        f"{source}: the file's units of mass, length and time are {given}, but the case or "
        f"mapping says `units: {words}`; correct `units`"
    )


def read_instants(
    records: FortranRecords, directory: HistoryDirectory, source: str
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Read time, shape (n,), and all values, shape (n, values), in the file's own units.

    Every instant must have the records that the directory announces.
    """
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


def _read_directory(records: FortranRecords, source: str) -> HistoryDirectory:
    head = records.next()
    code = struct.unpack_from(">i", head)[0] if len(head) >= 4 else 0
    length = next((length for codes, length in TITLES if code in codes), None)
    if length is None:
        known = " and ".join(f"{a} to {b}" for a, b in ((3000, 4020), (4021, 4099)))
        raise DataError(
            f"{source}: format code {code} is not known (known: {known}); convert the file to "
            "CSV and read that"
        )
    records.next()  # date and solver
    length, factors, counts = _further(records, code, length, source)
    if len(counts) != _COUNTS or any(not 0 <= n <= _MOST_OBJECTS for n in counts):
        raise DataError(
            f"{source}: the directory's counts {counts[:_COUNTS]} make no sense; the file is damaged: "
            "copy it again"
        )
    n_parts, n_materials, n_properties, n_subsets, n_groups, n_globals = counts
    globals_ = records.integers() if n_globals else ()
    titles, parts = [], []
    for _ in range(n_parts):
        description = _described(records, 20 + length, "a part's description", source)
        width = int(struct.unpack_from(">i", description, len(description) - 4)[0])
        titles.append(_titled(description, length))
        parts.append(records.integers() if width else ())
        _agree(len(parts[-1]), width, f"part `{titles[-1][1]}`", source)
    for _ in range(n_materials + n_properties):
        _described(records, 4 + length, "a material's or property's title", source)
    subset_width = 0
    for _ in range(n_subsets):
        description = _described(records, 20 + length, "a subset's description", source)
        _, _, n_children, n_members, width = struct.unpack_from(">5i", description)
        for count in (n_children, n_members, width):
            if count:
                _agree(len(records.integers()), count, "a subset", source)
        subset_width += width
    groups = []
    for _ in range(n_groups):
        description = _described(records, 20 + length, "a group's description", source)
        _, kind, _, n_objects, width = struct.unpack_from(">5i", description)
        objects = tuple(
            _titled(_described(records, 4 + length, "an object's title", source), length)
            for _ in range(n_objects)
        )
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
        factors,
        tuple(number for number, _ in titles),
    )


def _further(
    records: FortranRecords, code: int, length: int, source: str
) -> tuple[int, tuple[float, float, float] | None, tuple[int, ...]]:
    """Read the further records where there are any; return length of titles, units and the counts."""
    first = records.integers()
    if code < FURTHER_RECORDS or len(first) != 1:  # a file of 3050 without them begins with the counts
        return length, None, first
    factors = None
    for number in range(first[0]):
        content = records.next()
        if number == 0 and len(content) == _TITLE:
            length = int(struct.unpack(">i", content)[0])
        elif number == 1 and len(content) == _UNITS:
            mass, metre, second = struct.unpack(">3f", content)
            factors = (mass, metre, second)
        elif number < 2:
            raise DataError(
                f"{source}: the records that code {code} has for the length of titles and for the units have "
                f"{len(content)} bytes; the file is damaged: copy it again"
            )
    if not 0 < length <= 1000 or (factors and not all(math.isfinite(f) and f > 0 for f in factors)):
        raise DataError(
            f"{source}: titles of {length} characters and units of {factors} make no sense; the file is "
            "damaged: copy it again"
        )
    return length, factors, records.integers()


def _described(records: FortranRecords, size: int, what: str, source: str) -> bytes:
    description = records.next()
    if len(description) != size:
        raise DataError(
            f"{source}: {what} has {len(description)} bytes where its format code asks for {size}; the "
            "file is damaged, or of a version that is not known: copy it again, or convert it to CSV"
        )
    return description


def _named_groups(
    groups: list[tuple[int, tuple[tuple[int, str], ...], tuple[int, ...]]],
) -> Iterator[ObjectGroup]:
    """Name the objects of groups; one title of several nodes or contacts gets their ids."""
    for kind, objects, variables in groups:
        known = distinct(each for other, listed, _ in groups if other == kind for each in listed)
        ids = tuple(number for number, _ in objects)
        yield ObjectGroup(kind, tuple(known[number] for number in ids), variables, ids)


def _titled(description: bytes, length: int) -> tuple[int, str]:
    """Return the id and the title of a part, node or contact."""
    title = description[4 : 4 + length].decode("latin-1")
    return struct.unpack_from(">i", description)[0], plain(title).strip()


def _agree(found: int, announced: int, what: str, source: str) -> None:
    if found != announced:
        raise DataError(
            f"{source}: {what} announces {announced} variables and lists {found}; the file is "
            "damaged: copy it again"
        )
