"""OpenRadioss' native time history (`…T01`): big-endian Fortran records, a directory and then the instants.

For each instant: time, global values, part values, subset values, one record for each group that holds
something; all 32-bit. The head is read by `certkit.exchange.fe.radioss_directory`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from certkit.errors import DataError
from certkit.exchange.fe.checks import read_bytes, require_finite, require_time_axis
from certkit.exchange.fe.fortran_records import FortranRecords
from certkit.exchange.fe.histories import parse_units
from certkit.exchange.fe.one_file import one_file
from certkit.exchange.fe.radioss import part_histories
from certkit.exchange.fe.radioss_channels import Channels
from certkit.exchange.fe.radioss_directory import read_directory, read_instants, require_units
from certkit.exchange.fe.radioss_variables import (
    CONTACT_GROUP,
    ENERGIES,
    GLOBALS,
    GROUP_VARIABLES,
    NODE_GROUP,
    PART_VARIABLES,
)
from certkit.exchange.fe.run_radioss import RadiossRun

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    from certkit.definitions.extraction_case import HistoryFiles
    from certkit.definitions.virtual_test import FiniteElements
    from certkit.exchange.fe.histories import PartHistories

    Variables = dict[str, NDArray[np.float64]]


USUAL_FILES = ("*T01", "*T01.gz")


def holds(content: bytes) -> bool:
    """Tell a native history by the length of its first record."""
    return content[:3] == b"\x00\x00\x00"


def open_run(paths: Sequence[Path], layout: FiniteElements) -> RadiossRun:
    """Open a run that is graded."""
    if len(paths) > 1:
        raise DataError(f"{paths[1]}: an OpenRadioss run has one T01 here; name it in the mapping's `files`")
    return RadiossRun(paths[0], layout.units)


def read(paths: Sequence[Path], section: HistoryFiles) -> PartHistories:
    """Read the time history of a case."""
    channels = read_native(one_file(paths, section), section.units)
    return part_histories(channels, parse_units(section.units), section.rigid_bodies)


def read_native(path: Path, units: str | None = None) -> Channels:
    """Read a native OpenRadioss time history (`…T01` or `…T01.gz`).

    Parameters
    ----------
    path : Path
    units : str, optional
        Mass, length and time that the file's own unit factors are held against, where it has any.

    Raises
    ------
    DataError
        For anything that is no whole, self-consistent file of this kind, or one of other units.
    """
    content, digest = read_bytes(path)
    source = str(path)
    records = FortranRecords(content, source)
    directory = read_directory(records, source)
    remark = None if units is None else require_units(directory, parse_units(units), units, source)
    time, data = read_instants(records, directory, source)
    require_time_axis(time, source)
    columns = iter(data.T)
    energies = {
        GLOBALS[number - 1]: values
        for number, values in zip(directory.globals_, columns, strict=False)
        if number <= len(GLOBALS) and GLOBALS[number - 1] in ENERGIES
    }
    parts = {name: _named(variables, columns, PART_VARIABLES) for name, variables in directory.parts}
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
        impulses=True, source=source, digest=digest, notes=() if remark is None else (remark,),
        part_ids={name: n for n, (name, _) in zip(directory.part_ids, directory.parts, strict=True)},
    )  # fmt: skip


def _named(
    variables: tuple[int, ...], columns: Iterator[NDArray[np.float64]], names: Mapping[int, str]
) -> Variables:
    """Take one column a variable and keep those that have a name."""
    taken = {number: next(columns) for number in variables}
    return {names[number]: np.ascontiguousarray(v) for number, v in taken.items() if number in names}
